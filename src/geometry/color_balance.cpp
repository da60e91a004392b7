// SPDX-License-Identifier: Apache-2.0
#include "geometry/color_balance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/srgb.h"

namespace theatron {
namespace {

constexpr int depth_steps = 53;              // samples across a depth image, ...
constexpr int least_depth_step = 6;          // least pixels from one to the next
constexpr int color_step = 8;                // pixels that are averaged
constexpr std::size_t most_places = 20'000;  // looked at in one estimate
constexpr double least_places = 30;          // for two cameras to be compared
constexpr double follow = 0.2;               // share of a new estimate
constexpr double usual_places = 1;           // that count for a camera's usual gain
constexpr double srgb_exponent = 2.2;        // light is about this power of an sRGB value

double linear_from_srgb(int value) {
    static const auto table = [] {
        std::array<double, 256> t{};
        for (std::size_t i = 0; i < 256; ++i)
            t[i] = srgb_to_linear(double(i) / 255);
        return t;
    }();
    return table[std::size_t(value)];
}

// Usable values: below, one step is a large ratio; above, the value may be clipped.
bool tells(Vec3 light) {
    const auto good = [](double v) { return v > 0.01 && v < 0.85; };
    return good(light.x) && good(light.y) && good(light.z);
}

Vec3 light_of(Vec3 srgb) {
    const auto of = [](double v) { return std::pow(v, srgb_exponent); };
    return {of(srgb.x), of(srgb.y), of(srgb.z)};
}

// The factors of sRGB values.
Vec3 srgb_gain(Vec3 log_gain) {
    const auto of = [](double v) { return std::exp(std::clamp(v, -1.5, 1.5) / srgb_exponent); };
    return {of(log_gain.x), of(log_gain.y), of(log_gain.z)};
}

// Solves n linear equations, whose diagonal dominates; the solution replaces `right`.
void solve(std::vector<double>& matrix, std::vector<Vec3>& right) {
    const std::size_t n = right.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = matrix[i * n + k] / matrix[k * n + k];
            for (std::size_t j = k; j < n; ++j)
                matrix[i * n + j] -= factor * matrix[k * n + j];
            right[i] = right[i] - right[k] * factor;
        }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j)
            right[k] = right[k] - right[j] * matrix[k * n + j];
        right[k] = right[k] * (1 / matrix[k * n + k]);
    }
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
    if (camera.uploads++ % images_per_copy_ != 0 && !moved)
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
    // The same places of the scene, whatever the size of the image.
    const int depth_step = camera.depth_step =
        std::max(depth.size.width / depth_steps, least_depth_step);
    const Size small{depth.size.width / depth_step, depth.size.height / depth_step};
    camera.depth.resize(small);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            camera.depth.view().row(y)[x] =
                depth.row(y * depth_step + depth_step / 2)[x * depth_step + depth_step / 2];

    const Size cells{std::max(color.size.width / color_step, 1),
                     std::max(color.size.height / color_step, 1)};
    camera.light.resize(cells);
    const Vec3 gain = light_of(camera.calibration.color_gain.value_or(Vec3{1, 1, 1}));
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
    const int x = int(std::floor(pixel->x / camera.depth_step)),
              y = int(std::floor(pixel->y / camera.depth_step));
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

    // Least squares. The usual gains determine the values that no difference determines: the mean,
    // and cameras that share no surface with others.
    std::vector<double> matrix(n * n);
    std::vector<Vec3> log_gains(n);
    std::vector<bool> is_compared(n);
    for (std::size_t a = 0; a < n; ++a) {
        double& weight = matrix[a * n + a];
        weight = usual_places;
        if (cameras[a]->calibration.color_gain)
            continue;
        log_gains[a] = cameras[a]->usual_log_gain * usual_places;
        for (std::size_t b = 0; b < n; ++b) {
            if (b == a)
                continue;
            const Difference &there = differences[a * n + b], &back = differences[b * n + a];
            log_gains[a] =
                log_gains[a] + there.log_ratio * there.places - back.log_ratio * back.places;
            matrix[a * n + b] = -(there.places + back.places);
            weight += there.places + back.places;
        }
        is_compared[a] = weight > usual_places;
    }
    solve(matrix, log_gains);
    for (std::size_t a = 0; a < n; ++a) {
        Camera& camera = *cameras[a];
        const double share = camera.estimated ? follow : 1;
        camera.log_gain = camera.log_gain * (1 - share) + log_gains[a] * share;
        camera.estimated = camera.estimated || is_compared[a];
        camera.newest_log_gain = is_compared[a] ? std::optional(log_gains[a]) : std::nullopt;
    }
    return true;
}

void ColorBalance::set_usual_gain(CameraId id, Vec3 gain) {
    const auto log_light = [](double v) { return srgb_exponent * std::log(v); };
    cameras_.at(id).usual_log_gain = {log_light(gain.x), log_light(gain.y), log_light(gain.z)};
}

Vec3 ColorBalance::gain(CameraId id) const {
    const auto camera = cameras_.find(id);
    return camera == cameras_.end() ? Vec3{1, 1, 1} : srgb_gain(camera->second.log_gain);
}

std::optional<Vec3> ColorBalance::newest_gain(CameraId id) const {
    const auto camera = cameras_.find(id);
    if (camera == cameras_.end() || !camera->second.newest_log_gain)
        return std::nullopt;
    return srgb_gain(*camera->second.newest_log_gain);
}

}  // namespace theatron
