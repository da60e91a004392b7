// SPDX-License-Identifier: Apache-2.0
// Views of image memory that other objects own.
//
// A view is a pointer, a size and a stride; copying it copies no pixels. Rows
// are contiguous, top row first. Views are how every codec and filter takes and
// gives images.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace theatron {

struct Size {
    int width = 0;
    int height = 0;

    bool operator==(const Size&) const = default;
    std::size_t area() const { return std::size_t(width) * std::size_t(height); }
};

// Images larger than this on a side are refused everywhere.
inline constexpr int max_side = 8192;

constexpr bool is_valid(Size s) {
    return s.width > 0 && s.width <= max_side && s.height > 0 && s.height <= max_side;
}

// Pixels of type T. `stride` counts pixels from one row to the next.
template <class T>
struct View {
    T* pixels = nullptr;
    Size size;
    std::ptrdiff_t stride = 0;

    View() = default;
    View(T* p, Size s, std::ptrdiff_t row_stride) : pixels(p), size(s), stride(row_stride) {}
    View(T* p, Size s) : pixels(p), size(s), stride(s.width) {}
    // A view that may write is also one that may read.
    operator View<const T>() const { return {pixels, size, stride}; }

    T* row(int y) const { return pixels + y * stride; }
    bool contiguous() const { return stride == size.width; }
};

// Both of the same size; they do not overlap.
template <class T>
void copy_pixels(std::type_identity_t<View<const T>> from, View<T> to) {
    assert(from.size == to.size);
    for (int y = 0; y < from.size.height; ++y)
        std::copy_n(from.row(y), from.size.width, to.row(y));
}

// Depth in units of the camera's calibration (one millimetre unless it says
// otherwise), 0 = no measurement.
using DepthView = View<const std::uint16_t>;
using MutableDepthView = View<std::uint16_t>;

// One colour pixel in sRGB.
struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};
static_assert(sizeof(Rgb) == 3);

using ColorView = View<const Rgb>;
using MutableColorView = View<Rgb>;

}  // namespace theatron
