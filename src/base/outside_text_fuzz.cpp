// SPDX-License-Identifier: Apache-2.0
// Any bytes: the output is unchanged by a second pass, has no more characters than allowed, and
// is at most three times as long as the input.
#include <cstdint>
#include <cstdlib>

#include "base/outside_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0)
        return 0;
    const std::size_t limit = data[0];
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const std::string clean = theatron::clean_text(text, limit);
    std::size_t characters = 0;
    for (const char c : clean) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            std::abort();
        characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }
    if (characters > limit || clean.size() > 3 * text.size() ||
        theatron::clean_text(clean, limit) != clean)
        std::abort();
    return 0;
}
