// SPDX-License-Identifier: Apache-2.0
// Any bytes as a journal. Entries that were read are the same when they are written again, and a
// run goes on with them or names the problem.
#include <cstdint>
#include <cstdlib>

#include "study/built_in.h"
#include "study/study_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron::study;
    static const Questionnaires known = built_in_questionnaires();
    static const Protocol protocol = parse_protocol(example_protocol()).protocol;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const ReadJournal read = parse_journal(text);
    if (!read.problem.empty() || read.line == 0)
        return 0;
    const Journal& journal = read.journal;
    std::string again = journal_head(journal.participant, journal.hash);
    for (const JournalEntry& entry : journal.entries)
        again += journal_line(entry);
    const ReadJournal reread = parse_journal(again);
    if (!reread.problem.empty() || reread.journal.entries.size() != journal.entries.size() ||
        reread.journal.whole_bytes != again.size())
        std::abort();
    StudyRun run(protocol, known, *participant_number(journal.participant));
    if (run.resume(journal).empty() && run.state() == StudyRun::State::running)
        (void)run.reply("stop", theatron::TimePoint{});
    return 0;
}
