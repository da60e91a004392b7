// SPDX-License-Identifier: Apache-2.0
// Any text gives settings or a sentence. Settings survive spelling() and parsing, and their
// parameters are within the ranges that a chain accepts.
#include <cstdlib>
#include <string_view>

#include "filter/chain.h"

namespace {

using namespace theatron;

void check(const filter::ParsedChain& parsed) {
    if (!parsed.problem.empty()) {
        if (!parsed.settings.off())
            std::abort();
        return;
    }
    const filter::ParsedChain again = filter::parse_chain(parsed.settings.spelling());
    if (!again.problem.empty() || again.settings.steps != parsed.settings.steps)
        std::abort();
    filter::Chain chain(parsed.settings, {.size = {9, 5}});
    std::uint16_t in[45];
    for (std::size_t i = 0; i < 45; ++i)
        in[i] = std::uint16_t(i % 7 == 0 ? 0 : 1000 + i);
    for (int frame = 0; frame < 3; ++frame)
        chain.apply({in, {9, 5}}, std::chrono::milliseconds(33));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check(filter::parse_chain(text));
    check(filter::parse_chain_json(text));
    return 0;
}
