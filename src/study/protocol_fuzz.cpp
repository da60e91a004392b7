// SPDX-License-Identifier: Apache-2.0
// Any bytes as a protocol and as a file of questionnaires: both give mistakes that are fit to be
// shown, or a study whose steps have names of their own, all of whose scales have a value within
// their bounds when all is answered.
#include <cstdint>
#include <cstdlib>
#include <set>

#include "base/outside_text.h"
#include "study/built_in.h"
#include "study/study_run.h"

namespace {

using namespace theatron;
using namespace theatron::study;

void require(bool holds) {
    if (!holds)
        std::abort();
}

void check_mistakes(const std::vector<ConfigMistake>& mistakes) {
    for (const ConfigMistake& mistake : mistakes)
        require(!mistake.text.empty() &&
                clean_text(mistake.text, mistake.text.size()) == mistake.text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Questionnaires built_in = built_in_questionnaires();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    Questionnaires known = built_in;
    const auto mistakes = add_questionnaires(text, known);
    check_mistakes(mistakes);
    for (const Questionnaire& one : known.all) {
        Replies replies;
        for (const Item& item : one.items)
            replies[item.id] = item.lowest;
        const auto values = scores(one, replies);
        for (std::size_t s = 0; s < values.size(); ++s) {
            const auto [low, high] = bounds(one, s);
            require(values[s] && *values[s] >= low - 1e-6 && *values[s] <= high + 1e-6);
        }
    }
    const ReadProtocol read = parse_protocol(text);
    check_mistakes(read.mistakes);
    if (!read.mistakes.empty())
        return 0;
    const auto lacks = check_questionnaires(read.protocol, built_in);
    check_mistakes(lacks);
    if (!lacks.empty())
        return 0;
    std::set<std::string> ids;
    for (const Step& step : steps_of(read.protocol, built_in, 1 + int(size % 50)))
        require(ids.insert(step.id).second);
    return 0;
}
