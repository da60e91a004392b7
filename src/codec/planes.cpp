// SPDX-License-Identifier: Apache-2.0
#include "codec/planes.h"

#include <cassert>

#include "codec/rows.h"

namespace theatron::codec {

void split_planes(DepthView depth, DepthView reference, std::span<std::byte> planes) {
    const std::size_t area = depth.size.area();
    assert(planes.size() >= 2 * area);
    auto* low = reinterpret_cast<std::uint8_t*>(planes.data());
    auto* high = low + area;
    const int width = depth.size.width;
    const auto put = [&](int x, std::uint16_t from, std::uint16_t prediction) {
        const std::uint16_t code = zigzag(std::uint16_t(from - prediction));
        low[x] = std::uint8_t(code);
        high[x] = std::uint8_t(code >> 8);
    };
    for (int y = 0; y < depth.size.height; ++y, low += width, high += width) {
        const std::uint16_t* row = depth.row(y);
        if (reference.pixels != nullptr) {
            const std::uint16_t* before = reference.row(y);
            for (int x = 0; x < width; ++x)
                put(x, row[x], before[x]);
        } else {
            put(0, row[0], y > 0 ? depth.row(y - 1)[0] : std::uint16_t(0));
            for (int x = 1; x < width; ++x)
                put(x, row[x], row[x - 1]);
        }
    }
}

void join_planes(ByteView planes, DepthView reference, MutableDepthView out) {
    const std::size_t area = out.size.area();
    assert(planes.size() >= 2 * area);
    const auto* low = reinterpret_cast<const std::uint8_t*>(planes.data());
    const auto* high = low + area;
    const int width = out.size.width;
    const auto get = [&](int x) { return unzigzag(std::uint16_t(low[x] | high[x] << 8)); };
    for (int y = 0; y < out.size.height; ++y, low += width, high += width) {
        std::uint16_t* row = out.row(y);
        if (reference.pixels != nullptr) {
            const std::uint16_t* before = reference.row(y);
            for (int x = 0; x < width; ++x)
                row[x] = std::uint16_t(get(x) + before[x]);
        } else {
            std::uint16_t left = y > 0 ? out.row(y - 1)[0] : std::uint16_t(0);
            for (int x = 0; x < width; ++x)
                row[x] = left = std::uint16_t(left + get(x));
        }
    }
}

}  // namespace theatron::codec
