// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace theatron::viewer {
namespace {

constexpr double range_step_m = 0.25;
// Shares of the measured pixels that may be nearer or farther than the range.
constexpr double left_out = 0.02;
// Columns of the image that are read for the range, about.
constexpr int sampled_columns = 160;

constexpr std::array<Rgb, 5> stops{
    {{255, 240, 150}, {255, 170, 70}, {225, 85, 95}, {140, 50, 140}, {50, 40, 110}}};

double floor_to_step(double m) {
    return std::floor(m / range_step_m) * range_step_m;
}

Rgb color_at(double z, DepthRange range) {
    return depth_color((z - range.near_m) / (range.far_m - range.near_m));
}

std::uint8_t half_of(std::uint8_t a, std::uint8_t b) {
    return std::uint8_t((a + b) / 2);
}

// The colour camera's pixel of a point in the depth camera's frame.
std::optional<Rgb> color_of(const Calibration& calibration, const CameraModel& lens, Vec3 point,
                            ColorView color) {
    const auto pixel = project(lens, calibration.color_from_depth * point);
    if (!pixel)
        return std::nullopt;
    // Compared before conversion: values far outside do not fit an int.
    const double x = std::floor(pixel->x + 0.5), y = std::floor(pixel->y + 0.5);
    if (!(x >= 0 && x < color.size.width && y >= 0 && y < color.size.height))
        return std::nullopt;
    return color.row(int(y))[int(x)];
}

// Calls put(x, y, source x, source y) for each pixel of a picture of `size`.
template <class Put>
void for_each_nearest(Size source, Size size, const Put& put) {
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            put(x, y, int((2LL * x + 1) * source.width / (2LL * size.width)),
                int((2LL * y + 1) * source.height / (2LL * size.height)));
}

}  // namespace

std::optional<DepthRange> depth_range(const Calibration& calibration, DepthView depth) {
    std::vector<double> distances;
    const int step = std::max(1, depth.size.width / sampled_columns);
    for (int y = 0; y < depth.size.height; y += step)
        for (int x = 0; x < depth.size.width; x += step)
            if (const double z = depth_m(calibration, depth.row(y)[x]); z > 0)
                distances.push_back(z);
    if (distances.empty())
        return std::nullopt;
    const auto at = [&](double share) {
        const auto place = distances.begin() + std::ptrdiff_t(share * double(distances.size() - 1));
        std::nth_element(distances.begin(), place, distances.end());
        return *place;
    };
    const double near_m = floor_to_step(at(left_out));
    return DepthRange{near_m, std::max(floor_to_step(at(1 - left_out)), near_m) + range_step_m};
}

Rgb depth_color(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * double(stops.size() - 1);
    const auto first = std::min(std::size_t(place), stops.size() - 2);
    const double rest = place - double(first);
    const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
        return std::uint8_t(std::lround(a + rest * (b - a)));
    };
    const Rgb a = stops[first], b = stops[first + 1];
    return {mixed(a.r, b.r), mixed(a.g, b.g), mixed(a.b, b.b)};
}

Size fitted(Size image, int width) {
    if (image.width <= width)
        return image;
    return {width, std::max(1, int(std::lround(double(image.height) * width / image.width)))};
}

ColorImage reduced(ColorView color, Size size) {
    ColorImage picture(size);
    for (int y = 0; y < size.height; ++y) {
        const int top = int(std::int64_t(y) * color.size.height / size.height);
        const int bottom = int(std::int64_t(y + 1) * color.size.height / size.height);
        for (int x = 0; x < size.width; ++x) {
            const int left = int(std::int64_t(x) * color.size.width / size.width);
            const int right = int(std::int64_t(x + 1) * color.size.width / size.width);
            unsigned r = 0, g = 0, b = 0;
            for (int v = top; v < bottom; ++v)
                for (int u = left; u < right; ++u) {
                    const Rgb c = color.row(v)[u];
                    r += c.r;
                    g += c.g;
                    b += c.b;
                }
            const auto count = unsigned(bottom - top) * unsigned(right - left);
            picture.view().row(y)[x] = {std::uint8_t(r / count), std::uint8_t(g / count),
                                        std::uint8_t(b / count)};
        }
    }
    return picture;
}

ColorImage depth_picture(const Calibration& calibration, DepthView depth, Size size,
                         DepthRange range) {
    ColorImage picture(size);
    for_each_nearest(depth.size, size, [&](int x, int y, int from_x, int from_y) {
        if (const double z = depth_m(calibration, depth.row(from_y)[from_x]); z > 0)
            picture.view().row(y)[x] = color_at(z, range);
    });
    return picture;
}

ColorImage blended_picture(const Calibration& calibration, DepthView depth, const Image<Ray>& rays,
                           ColorView color, Size size, DepthRange range) {
    ColorImage picture(size);
    const CameraModel lens = scaled(calibration.color, color.size);
    for_each_nearest(depth.size, size, [&](int x, int y, int from_x, int from_y) {
        const double z = depth_m(calibration, depth.row(from_y)[from_x]);
        const Ray ray = rays.view().row(from_y)[from_x];
        if (z == 0 || ray.x == no_ray)
            return;
        const Rgb by_depth = color_at(z, range);
        const Rgb seen =
            color_of(calibration, lens, {ray.x * z, ray.y * z, z}, color).value_or(by_depth);
        picture.view().row(y)[x] = {half_of(by_depth.r, seen.r), half_of(by_depth.g, seen.g),
                                    half_of(by_depth.b, seen.b)};
    });
    return picture;
}

const CameraPictures::Pictures& CameraPictures::of(CameraId camera, std::uint64_t number,
                                                   const Calibration& calibration, DepthView depth,
                                                   std::shared_ptr<const ColorImage> color,
                                                   int width) {
    Kept& kept = kept_[camera];
    if (kept.width == width && kept.number == number && (!color || color == kept.color))
        return kept.pictures;
    kept.number = number;
    kept.width = width;
    if (color)
        kept.color = std::move(color);
    Pictures pictures;
    if (kept.color && !kept.color->empty())
        pictures.color = std::make_shared<ColorImage>(
            reduced(kept.color->view(), fitted(kept.color->size, width)));
    if (depth.size.area() > 0 && depth.size == calibration.depth.size) {
        if (kept.rays.empty() || kept.lens != calibration.depth) {
            kept.lens = calibration.depth;
            kept.rays = make_ray_table(calibration.depth);
        }
        if (const auto now = depth_range(calibration, depth)) {
            const DepthRange before = kept.range.value_or(*now);
            kept.range = {std::min(before.near_m, now->near_m), std::max(before.far_m, now->far_m)};
        }
        pictures.range = kept.range.value_or(DepthRange{0, 1});
        const Size size = fitted(depth.size, width);
        pictures.depth =
            std::make_shared<ColorImage>(depth_picture(calibration, depth, size, pictures.range));
        if (pictures.color)
            pictures.blended = std::make_shared<ColorImage>(blended_picture(
                calibration, depth, kept.rays, kept.color->view(), size, pictures.range));
    }
    return kept.pictures = std::move(pictures);
}

}  // namespace theatron::viewer
