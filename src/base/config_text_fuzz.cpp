// SPDX-License-Identifier: Apache-2.0
// Any bytes give lines and mistakes, each of a line of its own. Lines that are written again give
// the same lines, without a mistake.
#include <cstdint>
#include <cstdlib>

#include "base/config_text.h"
#include "base/outside_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ConfigText config = parse_config({reinterpret_cast<const char*>(data), size});
    std::string again;
    int last = 0;
    for (const ConfigLine& line : config.lines) {
        if (line.line <= last || line.value.empty())
            std::abort();
        last = line.line;
        again += line.key + "=\"" + line.value + "\"\n";
    }
    for (const ConfigMistake& mistake : config.mistakes)
        if (clean_text(mistake.text, mistake.text.size()) != mistake.text)
            std::abort();
    if (again.size() > max_config_bytes)
        return 0;
    const ConfigText reread = parse_config(again);
    if (!reread.mistakes.empty() || reread.lines.size() != config.lines.size())
        std::abort();
    for (std::size_t i = 0; i < config.lines.size(); ++i)
        if (reread.lines[i].key != config.lines[i].key ||
            reread.lines[i].value != config.lines[i].value)
            std::abort();
    return 0;
}
