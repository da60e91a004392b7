// SPDX-License-Identifier: Apache-2.0
#include "render/depth_offsets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "render/color_visibility.h"
#include "render/fewer_points.h"

namespace theatron::render {
namespace {

// Twice a second at first, less often later: a copy costs some milliseconds.
constexpr unsigned uploads_per_copy = 15, uploads_per_later_copy = 60;
constexpr int first_estimates = 8;
constexpr int largest_copy = 1280;  // columns of a colour picture
constexpr int sample_step = 2;      // depth pixels
constexpr double flat_m = 0.004;    // neighbours of a sample are as close to its plane
constexpr int finest = 2;           // pixels, of texture
constexpr int searched = 4;         // pixels, of texture for the search of the start
constexpr double search_step_m = 0.0025;
constexpr double least_texture = 8;      // steps of 255
constexpr double least_cosine = 0.3;     // at which both cameras must see a surface
constexpr double usual_difference = 30;  // between two cameras' textures; more counts less
constexpr double prior_weight = 1e8;     // pulls towards 0 where there is little texture
constexpr double follow = 0.2;           // smallest weight of a new estimate in the offset

// Every `step`th pixel.
void copy_brightness(ColorView color, int step, Image<std::uint8_t>& out) {
    out.resize({color.size.width / step, color.size.height / step});
    for (int y = 0; y < out.size.height; ++y) {
        const Rgb* in = color.row(y * step);
        std::uint8_t* row = out.view().row(y);
        for (int x = 0; x < out.size.width; ++x, in += step)
            row[x] = std::uint8_t((5 * in->r + 9 * in->g + 2 * in->b) / 16);
    }
}

// Difference between the brightness of a place and that of its surroundings, `around` pixels to
// either side. Exposure, shading and most gloss hardly change it.
std::optional<double> texture_at(View<const std::uint8_t> brightness, Vec2 place, int around) {
    const int x = int(std::floor(place.x)), y = int(std::floor(place.y));
    if (x < around || y < around || x + 1 + around >= brightness.size.width ||
        y + 1 + around >= brightness.size.height)
        return std::nullopt;
    const double u = place.x - x, v = place.y - y;
    const auto value = [&](int dx, int dy) {
        const std::uint8_t* above = brightness.row(y + dy) + x + dx;
        const std::uint8_t* below = brightness.row(y + dy + 1) + x + dx;
        return (above[0] * (1 - u) + above[1] * u) * (1 - v) +
               (below[0] * (1 - u) + below[1] * u) * v;
    };
    return value(0, 0) -
           (value(-around, 0) + value(around, 0) + value(0, -around) + value(0, around)) / 4;
}

// The plane through a pixel and its neighbours: depth in the middle, change to the next column and
// row.
struct Patch {
    double z = 0, to_right = 0, to_below = 0;
};

std::optional<Patch> patch_at(const Calibration& calibration, DepthView depth, int x, int y) {
    double z[3][3];
    Patch patch;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            z[j][i] = depth_m(calibration, depth.row(y + j - 1)[x + i - 1]);
            if (z[j][i] == 0)
                return std::nullopt;
            patch.z += z[j][i] / 9;
            patch.to_right += (i - 1) * z[j][i] / 6;
            patch.to_below += (j - 1) * z[j][i] / 6;
        }
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            if (std::abs(z[j][i] - patch.z - (i - 1) * patch.to_right - (j - 1) * patch.to_below) >
                flat_m)
                return std::nullopt;
    return patch;
}

}  // namespace

void DepthOffsets::add(CameraId id, const Calibration& given, DepthView depth, ColorView color) {
    // Gains do not concern the texture.
    Calibration calibration = given;
    calibration.color_gain.reset();
    // Colour registered to depth lies where its sender put it, up to half a pixel away.
    if (!color.pixels || calibration.color.size == Size{} || !may_be_hidden(calibration))
        return;
    Camera& camera = cameras_[id];
    const bool moved = camera.calibration != calibration;
    if (camera.passed_over > 0 && !moved) {
        --camera.passed_over;
        return;
    }
    // Cameras are copied in different pictures, to spread the cost.
    camera.passed_over =
        (camera.estimates < first_estimates ? uploads_per_copy : uploads_per_later_copy) +
        unsigned(std::distance(cameras_.begin(), cameras_.find(id)));
    if (camera.calibration.depth != calibration.depth || camera.rays.size == Size{})
        camera.rays = make_ray_table(every_nth(calibration.depth, sample_step));
    camera.calibration = calibration;
    if (!has_unknown_offsets())
        return;
    camera.depth.resize(depth.size);
    copy_pixels(depth, camera.depth.view());
    const int step = (color.size.width + largest_copy - 1) / largest_copy;
    copy_brightness(color, step, camera.brightness);
    camera.color = scaled(calibration.color, camera.brightness.size);
    // The copy has the first pixel of each block, not the block's mean.
    camera.color.cx += 0.5 - 0.5 / step;
    camera.color.cy += 0.5 - 0.5 / step;
    find_samples(camera);
    ++copies_;
}

bool DepthOffsets::has_unknown_offsets() const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [](const auto& entry) { return !entry.second.calibration.depth_offset_mm; });
}

void DepthOffsets::find_samples(Camera& camera) {
    const Calibration& c = camera.calibration;
    const double tan_per_pixel = 2 / (c.depth.fx + c.depth.fy);
    const auto depth = std::as_const(camera.depth).view();
    camera.samples.clear();
    // A sample has neighbours on all sides.
    for (int y = 1; y * sample_step + 1 < depth.size.height; ++y)
        for (int x = 1; x * sample_step + 1 < depth.size.width; ++x) {
            const Ray ray = camera.rays.view().row(y)[x];
            if (ray.x == no_ray || depth.row(y * sample_step)[x * sample_step] == 0)
                continue;
            const auto patch = patch_at(c, depth, x * sample_step, y * sample_step);
            if (!patch)
                continue;
            const Vec3 direction{ray.x, ray.y, 1}, point = direction * patch->z;
            const double footprint = patch->z * tan_per_pixel;
            const Vec3 right = direction * patch->to_right + Vec3{footprint, 0, 0};
            const Vec3 below = direction * patch->to_below + Vec3{0, footprint, 0};
            const Vec3 normal = normalized(cross(below, right));  // towards the camera
            if (dot(normal, point) > -least_cosine * length(point))
                continue;
            const auto place = project(camera.color, c.color_from_depth * point);
            if (!place)
                continue;
            const auto texture =
                texture_at(std::as_const(camera.brightness).view(), *place, finest);
            if (texture && std::abs(*texture) > least_texture)
                camera.samples.push_back({point, normal});
        }
}

// The equation for the offset of `a` that texture of this size (pixels) in `b` gives.
DepthOffsets::Equation DepthOffsets::compare(const Camera& a, const Camera& b, double offset_m,
                                             int size) {
    const Pose b_from_a = inverse(b.calibration.room_from_camera) * a.calibration.room_from_camera;
    const Pose color_from_a = b.calibration.color_from_depth * b_from_a;
    const Vec3 eye_b = inverse(b_from_a).translation;
    const auto seen_by_a = [&](Vec3 point) {
        const auto place = project(a.color, a.calibration.color_from_depth * point);
        return place ? texture_at(a.brightness.view(), *place, size) : std::nullopt;
    };
    const auto seen_by_b = [&](Vec3 point) {
        const auto place = project(b.color, color_from_a * point);
        return place ? texture_at(b.brightness.view(), *place, size) : std::nullopt;
    };
    // During the search both cameras may have their largest offsets.
    const bool coarse = size > finest;
    const double hidden_m = coarse ? 2 * largest_m : largest_m;
    Equation equation;
    for (std::size_t i = 0; i < a.samples.size(); i += coarse ? 4 : 1) {
        const Sample& s = a.samples[i];
        const Vec3 ray = s.point * (1 / s.point.z);
        const Vec3 point = s.point - ray * offset_m, from_b = point - eye_b;
        // From too different directions the two cameras see different sides.
        if (dot(s.normal, from_b) > -least_cosine * length(from_b) || dot(ray, from_b) < 0)
            continue;
        const Vec3 there = b_from_a * point;
        const auto pixel = project(b.calibration.depth, there);
        if (!pixel)
            continue;
        const int x = int(std::lround(pixel->x)), y = int(std::lround(pixel->y));
        if (x < 0 || y < 0 || x >= b.depth.size.width || y >= b.depth.size.height ||
            std::abs(depth_m(b.calibration, b.depth.view().row(y)[x]) - there.z) > hidden_m)
            continue;
        // Texture in b if the point is nearer or further by half a texture's size, and the place
        // on the surface of `a` to which that move corresponds.
        const double step = 0.5 * size * there.z / b.color.fx;
        const Vec3 along = ray - from_b * (dot(ray, s.normal) / dot(from_b, s.normal));
        const auto texture = seen_by_a(s.point), here = seen_by_b(point),
                   nearer = seen_by_b(point - ray * step), further = seen_by_b(point + ray * step),
                   before = seen_by_a(s.point - along * step),
                   after = seen_by_a(s.point + along * step);
        if (!texture || !here || !nearer || !further || !before || !after)
            continue;
        // The product of the slopes in both pictures, not the square of one: a slope in only one
        // picture is no evidence, and its square would count noise as certainty.
        const double difference = *texture - *here;
        const double trust =
            1 / (1 + difference * difference / (usual_difference * usual_difference));
        const double slope_a = (*before - *after) / (2 * step);
        const double slope_b = (*nearer - *further) / (2 * step);
        equation.cost += trust * difference * difference;
        ++equation.samples;
        equation.error += trust * slope_a * difference;
        equation.weight += trust * slope_a * slope_b;
    }
    return equation;
}

DepthOffsets::Equation DepthOffsets::compare_with_others(CameraId id, double offset_m,
                                                         int size) const {
    Equation sum;
    for (const auto& [other_id, other] : cameras_)
        if (other_id != id) {
            const Equation e = compare(cameras_.at(id), other, offset_m, size);
            sum.error += e.error;
            sum.weight += e.weight;
            sum.cost += e.cost;
            sum.samples += e.samples;
        }
    return sum;
}

// From there the nearest minimum is the right one.
double DepthOffsets::best_start_m(CameraId id) const {
    struct Try {
        double offset_m, cost, samples;
    };
    std::vector<Try> tries;
    double most = 0;
    for (int i = 0; i <= int(largest_m / search_step_m); ++i)
        for (const double offset : {i * search_step_m, -i * search_step_m}) {
            const Equation e = compare_with_others(id, offset, searched);
            tries.push_back({offset, e.cost / std::max(e.samples, 1.0), e.samples});
            most = std::max(most, e.samples);
        }
    // Few samples agree by chance.
    std::erase_if(tries, [&](const Try& t) { return t.samples == 0 || t.samples < 0.7 * most; });
    const auto best = std::min_element(tries.begin(), tries.end(),
                                       [](const Try& a, const Try& b) { return a.cost < b.cost; });
    return best == tries.end() ? 0 : best->offset_m;
}

bool DepthOffsets::update() {
    if (waiting_.empty() && cameras_.size() > 1 && copies_ >= cameras_.size()) {
        copies_ = 0;
        for (const auto& [id, camera] : cameras_)
            if (!camera.calibration.depth_offset_mm)
                waiting_.insert(waiting_.begin(), id);
    }
    if (waiting_.empty())
        return false;
    // New cameras at once, so that no picture is drawn without their offsets.
    bool is_new;
    do {
        Camera& camera = cameras_.at(waiting_.back());
        is_new = camera.estimates == 0;
        estimate(waiting_.back(), camera);
        waiting_.pop_back();
    } while (is_new && !waiting_.empty());
    return true;
}

void DepthOffsets::estimate(CameraId id, Camera& camera) {
    double offset = camera.estimates > 0 ? camera.offset_m : best_start_m(id);
    std::vector<int> sizes{finest};
    if (camera.estimates == 0)
        sizes = {searched, searched, finest, finest, finest, finest};
    for (const int size : sizes) {
        const Equation sum = compare_with_others(id, offset, size);
        const double weight = std::max(sum.weight, 0.0) + prior_weight;
        offset += (sum.error - prior_weight * offset) / weight;
        offset = std::clamp(offset, -largest_m, largest_m);
    }
    // The mean of the first ones, later of those of some time.
    ++camera.estimates;
    camera.offset_m += std::max(1.0 / camera.estimates, follow) * (offset - camera.offset_m);
}

double DepthOffsets::offset_m(CameraId id) const {
    const auto camera = cameras_.find(id);
    return camera == cameras_.end() ? 0 : camera->second.offset_m;
}

}  // namespace theatron::render
