// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_rle.h"

#include <algorithm>

namespace theatron::cases {
namespace {

constexpr std::size_t header_bytes = 64;

std::size_t word(ByteView frame, std::size_t number) {
    return load_le<std::uint32_t>(frame.data() + 4 * number);
}

// Adds each byte of the segment to a value, eight bits above what that has already.
bool unpack_segment(ByteView packed, std::vector<int>& values) {
    std::size_t from = 0, to = 0;
    const auto put = [&](std::byte byte) {
        // Rows of an odd length may have a byte more at the end.
        if (to < values.size())
            values[to] = values[to] << 8 | std::to_integer<int>(byte);
        ++to;
    };
    while (to < values.size()) {
        if (from == packed.size())
            return false;
        const int control = std::int8_t(std::to_integer<int>(packed[from++]));
        if (control == -128)
            continue;
        const bool repeats = control < 0;
        const std::size_t count = std::size_t(repeats ? 1 - control : 1 + control);
        if (packed.size() - from < (repeats ? 1 : count))
            return false;
        for (std::size_t i = 0; i < count; ++i)
            put(packed[from + (repeats ? 0 : i)]);
        from += repeats ? 1 : count;
    }
    return true;
}

}  // namespace

bool unpack_rle(ByteView frame, int bytes, std::vector<int>& values) {
    const std::size_t segments = std::size_t(bytes);
    if (frame.size() < header_bytes || word(frame, 0) != segments)
        return false;
    std::fill(values.begin(), values.end(), 0);
    for (std::size_t i = 1; i <= segments; ++i) {
        const std::size_t begin = word(frame, i);
        const std::size_t end = i < segments ? word(frame, i + 1) : frame.size();
        if (begin < header_bytes || end < begin || end > frame.size() ||
            !unpack_segment(frame.subspan(begin, end - begin), values))
            return false;
    }
    return true;
}

}  // namespace theatron::cases
