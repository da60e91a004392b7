// SPDX-License-Identifier: Apache-2.0
#include "render/color_balance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace theatron::render {
namespace {

constexpr unsigned uploads_per_copy = 15;    // twice a second
constexpr int depth_step = 12;               // pixels between samples
constexpr int color_step = 8;                // pixels that are averaged
constexpr std::size_t most_places = 20'000;  // looked at in one estimate
constexpr double least_places = 30;          // for two cameras to be compared
constexpr double follow = 0.2;               // share of a new estimate

double linear_from_srgb(int value) {
    static const auto table = [] {
        std::array<double, 256> t{};
        for (std::size_t i = 0; i < 256; ++i) {
            const double v = double(i) / 255;
            t[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        return t;
    }();
    return table[std::size_t(value)];
}

// Usable values: below, one step is a large ratio; above, the value may be clipped.
bool tells(Vec3 light) {
    const auto good = [](double v) { return v > 0.01 && v < 0.85; };
    return good(light.x) && good(light.y) && good(light.z);
}

double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

void ColorBalance::add(CameraId id, const Calibration& calibration, DepthView depth,
                       ColorView color) {
    if (!color.pixels || calibration.color.size == Size{})
        return;
    Camera& camera = cameras_[id];
    const bool moved = camera.calibration != calibration;
    if (camera.uploads++ % uploads_per_copy != 0 && !moved)
        return;
    camera.calibration = calibration;
    if (!has_unknown_gains())
        return;
    copy_images(camera, depth, color);
    ++copies_;
}

bool ColorBalance::has_unknown_gains() const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [](const auto& entry) { return !entry.second.calibration.color_gain; });
}

void ColorBalance::copy_images(Camera& camera, DepthView depth, ColorView color) {
    const Size small{depth.size.width / depth_step, depth.size.height / depth_step};
    camera.depth.resize(small);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            camera.depth.view().row(y)[x] =
                depth.row(y * depth_step + depth_step / 2)[x * depth_step + depth_step / 2];

    const Size cells{std::max(color.size.width / color_step, 1),
                     std::max(color.size.height / color_step, 1)};
    camera.light.resize(cells);
    // sRGB is about the 2.2nd root of light.
    const Vec3 known = camera.calibration.color_gain.value_or(Vec3{1, 1, 1});
    const Vec3 gain{std::pow(known.x, 2.2), std::pow(known.y, 2.2), std::pow(known.z, 2.2)};
    for (int cy = 0; cy < cells.height; ++cy)
        for (int cx = 0; cx < cells.width; ++cx) {
            Vec3 sum;
            double count = 0;
            for (int y = cy * color_step; y < std::min((cy + 1) * color_step, color.size.height);
                 y += 2)
                for (int x = cx * color_step; x < std::min((cx + 1) * color_step, color.size.width);
                     x += 2) {
                    const Rgb p = color.row(y)[x];
                    sum = sum +
                          Vec3{linear_from_srgb(p.r), linear_from_srgb(p.g), linear_from_srgb(p.b)};
                    ++count;
                }
            camera.light.view().row(cy)[cx] =
                Vec3{sum.x * gain.x, sum.y * gain.y, sum.z * gain.z} * (1 / count);
        }
    camera.color = scaled(camera.calibration.color, cells);

    const Calibration& c = camera.calibration;
    camera.samples.clear();
    for (int y = 1; y + 1 < small.height; ++y)
        for (int x = 1; x + 1 < small.width; ++x) {
            const double z = depth_m(c, camera.depth.view().row(y)[x]);
            if (z == 0)
                continue;
            const auto ray = unproject(c.depth, {double(x * depth_step + depth_step / 2),
                                                 double(y * depth_step + depth_step / 2)});
            if (!ray)
                continue;
            const Vec3 point = c.room_from_camera * Vec3{ray->x * z, ray->y * z, z};
            if (const auto light = light_at(camera, point))
                camera.samples.push_back({point, *light});
        }
}

// The mean light around the pixel of this point; empty if the camera does not see it.
std::optional<Vec3> ColorBalance::light_at(const Camera& camera, Vec3 point_room) {
    const Calibration& c = camera.calibration;
    const Vec3 p = inverse(c.room_from_camera) * point_room;
    const auto pixel = project(c.depth, p);
    if (!pixel)
        return std::nullopt;
    const int x = int(std::floor(pixel->x / depth_step)),
              y = int(std::floor(pixel->y / depth_step));
    const Size small = camera.depth.size;
    if (x < 1 || y < 1 || x + 1 >= small.width || y + 1 >= small.height)
        return std::nullopt;
    // All neighbours must be on the same surface: at edges light comes from both sides.
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const double z = depth_m(c, camera.depth.view().row(y + dy)[x + dx]);
            if (std::abs(z - p.z) > (dx == 0 && dy == 0 ? 0.02 : 0.06) + 0.02 * p.z)
                return std::nullopt;
        }
    const auto place = project(camera.color, c.color_from_depth * p);
    if (!place)
        return std::nullopt;
    const int cx = int(std::lround(place->x)), cy = int(std::lround(place->y));
    const Size cells = camera.light.size;
    if (cx < 0 || cy < 0 || cx >= cells.width || cy >= cells.height)
        return std::nullopt;
    const Vec3 light = camera.light.view().row(cy)[cx];
    return tells(light) ? std::optional(light) : std::nullopt;
}

ColorBalance::Difference ColorBalance::compare(const Camera& a, const Camera& b,
                                               std::size_t step) const {
    std::vector<double> ratios[3];
    const Vec3 eye_a = a.calibration.room_from_camera.translation;
    const Vec3 eye_b = b.calibration.room_from_camera.translation;
    for (std::size_t i = 0; i < a.samples.size(); i += step) {
        const Sample& s = a.samples[i];
        // From opposite sides they see two sides of something thin.
        if (dot(normalized(eye_a - s.point_room), normalized(eye_b - s.point_room)) < -0.1)
            continue;
        const auto light = light_at(b, s.point_room);
        if (!light)
            continue;
        ratios[0].push_back(std::log(light->x / s.light.x));
        ratios[1].push_back(std::log(light->y / s.light.y));
        ratios[2].push_back(std::log(light->z / s.light.z));
    }
    Difference difference;
    difference.places = double(ratios[0].size() * step);
    if (difference.places < least_places)
        return {};
    difference.log_ratio = {median(ratios[0]), median(ratios[1]), median(ratios[2])};
    return difference;
}

bool ColorBalance::update() {
    if (cameras_.size() < 2 || copies_ < cameras_.size() || !has_unknown_gains())
        return false;
    copies_ = 0;
    std::vector<Camera*> cameras;
    std::size_t places = 0;
    for (auto& [id, camera] : cameras_) {
        cameras.push_back(&camera);
        places += camera.samples.size() * (cameras_.size() - 1);
    }
    const std::size_t step = 1 + places / most_places, n = cameras.size();
    std::vector<Difference> differences(n * n);
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
            if (a != b)
                differences[a * n + b] = compare(*cameras[a], *cameras[b], step);

    // Least squares by relaxation. A weak pull towards 0 determines the values that no difference
    // determines: the mean, and cameras that share no surface with others.
    std::vector<Vec3> log_gains(n);
    for (int round = 0; round < 60; ++round)
        for (std::size_t a = 0; a < n; ++a) {
            if (cameras[a]->calibration.color_gain)
                continue;
            Vec3 sum;
            double weight = 1;
            for (std::size_t b = 0; b < n; ++b) {
                const Difference &there = differences[a * n + b], &back = differences[b * n + a];
                sum = sum + (log_gains[b] + there.log_ratio) * there.places +
                      (log_gains[b] - back.log_ratio) * back.places;
                weight += there.places + back.places;
            }
            log_gains[a] = sum * (1 / weight);
        }
    for (std::size_t a = 0; a < n; ++a) {
        Camera& camera = *cameras[a];
        const double share = camera.estimated ? follow : 1;
        camera.log_gain = camera.log_gain * (1 - share) + log_gains[a] * share;
        for (std::size_t b = 0; b < n; ++b)
            camera.estimated = camera.estimated || differences[a * n + b].places > 0;
    }
    return true;
}

Vec3 ColorBalance::gain(CameraId id) const {
    const auto camera = cameras_.find(id);
    if (camera == cameras_.end())
        return {1, 1, 1};
    // sRGB is about the 2.2nd root of light.
    const auto srgb = [](double log_gain) {
        return std::exp(std::clamp(log_gain, -1.5, 1.5) / 2.2);
    };
    const Vec3 g = camera->second.log_gain;
    return {srgb(g.x), srgb(g.y), srgb(g.z)};
}

}  // namespace theatron::render
