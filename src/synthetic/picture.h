// SPDX-License-Identifier: Apache-2.0
// Flat pictures in the room: printed sheets, labels, screens.
#pragma once

#include <string_view>
#include <vector>

#include "image/image.h"
#include "synthetic/vec3f.h"

namespace theatron::synthetic {

// An sRGB picture that can be sampled at any scale without aliasing.
class Picture {
public:
    explicit Picture(ColorImage image);

    // Linear colour at (u, v), v down; `blur` is the width of a sample as a share of the
    // picture's width.
    F3 sample(float u, float v, float blur) const;

private:
    std::vector<ColorImage> levels_;  // each half as large as the one before (mipmap)
};

// The pictures of the room, in this order.
enum class PictureNumber {
    checklist,
    monitor_vitals,
    monitor_slice,
    anaesthesia,
    label,
    clock,
    calibration_note,
    count
};
std::vector<Picture> make_pictures();

// A canvas for drawing such pictures, with antialiasing.
class Canvas {
public:
    Canvas(Size size, Rgb background);
    const ColorImage& image() const { return image_; }
    ColorImage& image() { return image_; }

    void rectangle(float x0, float y0, float x1, float y1, Rgb color);
    void line(float x0, float y0, float x1, float y1, float width, Rgb color);
    void ellipse(float cx, float cy, float rx, float ry, float turn, Rgb color);
    // Draws capital letters, digits and some signs of this height; (x, y) is the top left.
    // Returns the x after the text.
    float text(float x, float y, float height, std::string_view text, Rgb color);

private:
    void blend_pixel(int x, int y, Rgb color, float share);
    ColorImage image_;
};

float linear_from_srgb(std::uint8_t value);

}  // namespace theatron::synthetic
