// SPDX-License-Identifier: Apache-2.0
#include "video/plane_pixels.h"

#include "video/clamped.h"

namespace theatron::video {
namespace {

// 1 in the fractions of the JFIF specification's matrix.
constexpr int one = 1 << 16;
constexpr int half = one / 2;
constexpr int fraction(double value) {
    return int(value * one + 0.5);
}

// Chroma adds this to the three colours of a pixel.
struct Shift {
    int red, green, blue;
};

Shift shift_of(int u, int v) {
    u -= 128;
    v -= 128;
    return {(fraction(1.402) * v + half) >> 16,
            (-fraction(0.34414) * u - fraction(0.71414) * v + half) >> 16,
            (fraction(1.772) * u + half) >> 16};
}

Rgb shifted(std::byte luma, const Shift& shift) {
    const int y = std::to_integer<int>(luma);
    return {clamped(y + shift.red), clamped(y + shift.green), clamped(y + shift.blue)};
}

// The bytes from a plane's first to its last sample.
bool lies_within(std::size_t size, std::size_t first, std::size_t stride, std::size_t step,
                 std::size_t width, std::size_t height) {
    // No picture has that many; products of them do not wrap.
    constexpr std::size_t most = std::size_t(1) << 15;
    if (width > most || height > most || stride > most * 4 || step > 4 || first > size)
        return false;
    const std::uint64_t last = std::uint64_t(height - 1) * stride + std::uint64_t(width - 1) * step;
    return (width - 1) * step < stride && last < size - first;
}

}  // namespace

Status pixels_of_planes(ByteView samples, const PlaneLayout& layout, MutableColorView out) {
    const auto [width, height] = out.size;
    if (width <= 0 || height <= 0)
        return Status::ok;
    const auto chroma_width = std::size_t(width + 1) / 2,
               chroma_height = std::size_t(height + 1) / 2;
    const std::size_t size = samples.size();
    if (!lies_within(size, layout.y, layout.y_stride, 1, std::size_t(width), std::size_t(height)) ||
        !lies_within(size, layout.u, layout.chroma_stride, layout.chroma_step, chroma_width,
                     chroma_height) ||
        !lies_within(size, layout.v, layout.chroma_stride, layout.chroma_step, chroma_width,
                     chroma_height))
        return Status::truncated;

    for (int row = 0; row < height; ++row) {
        const std::byte* y = samples.data() + layout.y + std::size_t(row) * layout.y_stride;
        const std::size_t chroma_row = std::size_t(row / 2) * layout.chroma_stride;
        const std::byte* u = samples.data() + layout.u + chroma_row;
        const std::byte* v = samples.data() + layout.v + chroma_row;
        Rgb* to = out.row(row);
        Rgb* const end = to + width;
        for (; to < end; u += layout.chroma_step, v += layout.chroma_step) {
            const Shift shift = shift_of(std::to_integer<int>(*u), std::to_integer<int>(*v));
            *to++ = shifted(*y++, shift);
            if (to < end)
                *to++ = shifted(*y++, shift);
        }
    }
    return Status::ok;
}

Status pixels_of_quads(ByteView samples, std::size_t first, std::size_t stride,
                       MutableColorView out) {
    const auto [width, height] = out.size;
    if (width <= 0 || height <= 0)
        return Status::ok;
    // The last byte of a row is passed over, but is there.
    if (!lies_within(samples.size(), first, stride, 1, 4 * std::size_t(width), std::size_t(height)))
        return Status::truncated;
    for (int row = 0; row < height; ++row) {
        const std::byte* from = samples.data() + first + std::size_t(row) * stride;
        for (Rgb* to = out.row(row); to < out.row(row) + width; ++to, from += 4)
            *to = {std::to_integer<std::uint8_t>(from[0]), std::to_integer<std::uint8_t>(from[1]),
                   std::to_integer<std::uint8_t>(from[2])};
    }
    return Status::ok;
}

}  // namespace theatron::video
