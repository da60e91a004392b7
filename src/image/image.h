// SPDX-License-Identifier: Apache-2.0
// Images that own their pixels.
#pragma once

#include <vector>

#include "image/view.h"

namespace theatron {

template <class T>
struct Image {
    Size size;
    std::vector<T> pixels;  // size.area() of them, no padding between rows

    Image() = default;
    explicit Image(Size s) : size(s), pixels(s.area()) {}

    View<const T> view() const { return {pixels.data(), size}; }
    View<T> view() { return {pixels.data(), size}; }
    bool empty() const { return pixels.empty(); }

    // Gives the image a size, keeping the memory it already has.
    void resize(Size s) {
        size = s;
        pixels.resize(s.area());
    }
    bool operator==(const Image&) const = default;
};

using DepthImage = Image<std::uint16_t>;
using ColorImage = Image<Rgb>;

// A copy of the pixels that a view shows.
inline DepthImage copy_of(DepthView view) {
    DepthImage image(view.size);
    copy_pixels(view, image.view());
    return image;
}

}  // namespace theatron
