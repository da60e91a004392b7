// SPDX-License-Identifier: Apache-2.0
#include "study_session.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <optional>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "files/journal_file.h"
#include "files/private_file.h"
#include "study_folder.h"
#include "study_link.h"
#include "study_terminal.h"

namespace theatron::app {
namespace {

using study::Step;
using study::StudyRun;

// A pipe from which a host reads its lines.
void tell_host(const std::string& path, const std::string& line) {
    if (path.empty())
        return;
    const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0 && errno == ENXIO)
        throw Error("No host reads from '" + path + "'; start it with: theatron host ... < " +
                    path + ".");
    if (file < 0)
        throw Error("Cannot write to '" + path + "': " + std::strerror(errno) + ".");
    const std::string text = line + "\n";
    const bool is_written = write(file, text.data(), text.size()) == ssize_t(text.size());
    close(file);
    if (!is_written)
        throw Error("The host does not take the line '" + line + "' from '" + path + "'.");
}

// Writes nothing while somebody types.
void wait_for_time(const Step& step, const StudyTerminal& surface) {
    if (step.watch_s == 0 || !isatty(STDIN_FILENO))
        return;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, step.watch_s * 1000) == 0)
        surface.over();
}

std::optional<StudyRun> begun(const Study& study, const std::string& participant,
                              files::JournalFile& file) {
    const std::string path = study.journal_of(participant).string();
    const std::string text = file.text(study::max_journal_bytes);
    const study::ReadJournal read = study::parse_journal(text);
    if (!read.problem.empty())
        throw Error("'" + path + "', line " + std::to_string(read.line) + ": " + read.problem +
                    "; the run cannot go on.");
    if (read.line > 0)
        require_own_journal(path, read.journal, participant);
    if (read.line > 0 && read.journal.hash != study.hash)
        throw Error(
            "The protocol or its questionnaires were changed since " + participant +
            " began; put their earlier text back (the folder 'texts' keeps it), or take another "
            "pseudonym.");
    StudyRun run(study.protocol, study.questionnaires, *study::participant_number(participant));
    if (const std::string problem = run.resume(read.journal); !problem.empty())
        throw Error("'" + path + "': " + problem);
    if (run.state() != StudyRun::State::running)
        throw Error("The run of " + participant + " is " + study::text_of(run.state()) +
                    " already; another participant needs another pseudonym.");
    if (read.line == 0)
        keep_texts(study);
    if (read.journal.whole_bytes < text.size())
        file.keep(read.journal.whole_bytes);
    file.append(read.line == 0 ? study::journal_head(participant, study.hash) : run.resumed_line());
    return run;
}

}  // namespace

void run_study(const StudyRunFlags& flags) {
    const Study study = load_study(flags.folder);
    if (!study::participant_number(flags.participant))
        throw Error("'" + flags.participant +
                    "' is no pseudonym; write a capital letter and a number, such as P07, and "
                    "never a name.");
    files::open_private_folder(study.journal_of(flags.participant).parent_path());
    require_other_number(study, flags.participant);
    files::JournalFile file(study.journal_of(flags.participant));
    const bool is_resumed = !file.text(study::max_journal_bytes).empty();
    if (!is_resumed)
        if (const auto others = begun_with_another_text(study); !others.empty())
            log::say(another_text_note(others));
    StudyRun run = *begun(study, flags.participant, file);
    const StudyTerminal surface(study, flags.json);
    surface.begin(run, flags.participant, is_resumed);
    if (!flags.link.empty()) {
        lead_study(study, flags, run, file, surface);
        return surface.end(run);
    }
    if (!flags.json)
        std::printf("'stop' ends the study at any time; '-' leaves a question out.\n");
    // A host that was started again knows nothing of the condition in whose midst the run goes on.
    if (const int at = run.current().condition; is_resumed && at >= 0) {
        const study::Condition& condition = study.protocol.conditions[std::size_t(at)];
        tell_host(flags.host_input, host_line(condition));
        surface.remind(condition);
    }
    while (run.state() == StudyRun::State::running) {
        const Step step = run.current();
        if (step.kind == Step::Kind::condition)
            tell_host(flags.host_input,
                      host_line(study.protocol.conditions[std::size_t(step.condition)]));
        surface.show(run);
        run.show(steady_now());
        wait_for_time(step, surface);
        while (true) {
            std::string text;
            if (!std::getline(std::cin, text))
                throw Error("The input ended before the run: the same command goes on at step " +
                            std::to_string(run.position() + 1) + ".");
            const StudyRun::Answer answer = run.reply(text, steady_now());
            if (answer.problem.empty()) {
                file.append(answer.line);
                surface.saved(step.id);
                break;
            }
            surface.refuse(answer.problem);
        }
    }
    tell_host(flags.host_input, "renderer all free");
    surface.end(run);
}

}  // namespace theatron::app
