// SPDX-License-Identifier: Apache-2.0
#include "render/shades.h"

#include <algorithm>
#include <cmath>

namespace theatron::render {
namespace {

constexpr int reach = 3;  // pixels on each side whose depth tells the slope, against noise
// Neighbours on one surface: the noise of a sensor, and a slope of 72 degrees.
constexpr double noise_mm = 12, steepest = 3;
// Towards the light in the camera's frame, of length 1: x right, y down, z forward.
constexpr Vec3 light{-0.36, -0.48, -0.8};
constexpr double darkest = 40, brightest = 200;

// The change of depth to the next pixel along one axis, by least squares through this pixel.
// `before` and `after` are the pixels of the image on both sides; `step` is between their places.
double slope(const std::uint16_t* pixel, std::ptrdiff_t step, int before, int after, double noise,
             double steepest_step) {
    double sum = 0;
    int weight = 0;
    for (int k = -std::min(before, reach); k <= std::min(after, reach); ++k) {
        const int other = pixel[k * step], change = other - *pixel;
        if (other == 0 || std::abs(change) > noise + std::abs(k) * steepest_step)
            continue;
        sum += k * change;
        weight += k * k;
    }
    return weight > 0 ? sum / weight : 0;
}

}  // namespace

void shade(DepthView depth, const Calibration& calibration, ColorImage& out) {
    const auto [width, height] = depth.size;
    out.resize({(width + 1) / 2, (height + 1) / 2});
    const CameraModel& lens = calibration.depth;
    const double noise = noise_mm / calibration.depth_unit_mm;
    for (int y = 0; y < height; y += 2) {
        const std::uint16_t* row = depth.row(y);
        Rgb* out_row = out.view().row(y / 2);
        for (int x = 0; x < width; x += 2) {
            const std::uint16_t* pixel = row + x;
            // Slopes per metre across the surface; a pixel covers z / f. Distortion is neglected.
            const double right = *pixel / lens.fx, below = *pixel / lens.fy;
            Vec3 normal{0, 0, -1};
            if (*pixel != 0) {
                const double a = slope(pixel, 1, x, width - 1 - x, noise, steepest * right) / right;
                const double b =
                    slope(pixel, depth.stride, y, height - 1 - y, noise, steepest * below) / below;
                normal = {a, b, -1 - a * (x - lens.cx) / lens.fx - b * (y - lens.cy) / lens.fy};
            }
            const double lit = std::max(dot(normal, light), 0.0) / length(normal);
            const auto grey =
                std::uint8_t(std::lround(darkest + (brightest - darkest) * std::min(lit, 1.0)));
            out_row[x / 2] = {grey, grey, grey};
        }
    }
}

}  // namespace theatron::render
