// SPDX-License-Identifier: Apache-2.0
#include "registration/edge_prediction.h"

#include <cmath>

#include "registration/plane_search.h"

namespace theatron::registration {
namespace {

using namespace mixed_light;

constexpr float weights[5] = {float(second_light), float(next_light),
                              float(1 - 2 * (next_light + second_light)), float(next_light),
                              float(second_light)};

}  // namespace

PixelWindow window_of(const DepthLookup& lookup, const Pose& camera_from_face,
                      const LatticeTarget& target) {
    const Rect r = outline(target);
    PixelWindow w{lookup.depth.size.width, lookup.depth.size.height, 0, 0};
    constexpr double rim = 0.03;
    constexpr int steps = 8;  // lenses bend straight edges
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
            const Vec3 p =
                camera_from_face * Vec3{r.left - rim + (r.width() + 2 * rim) * i / steps,
                                        r.bottom - rim + (r.height() + 2 * rim) * j / steps, 0};
            const auto pixel = project(*lookup.camera, p);
            if (!pixel)
                continue;
            w.left = std::min(w.left, int(pixel->x) - 2);
            w.right = std::max(w.right, int(pixel->x) + 3);
            w.top = std::min(w.top, int(pixel->y) - 2);
            w.bottom = std::max(w.bottom, int(pixel->y) + 3);
        }
    return {std::max(w.left, 0), std::max(w.top, 0), std::min(w.right, lookup.depth.size.width),
            std::min(w.bottom, lookup.depth.size.height)};
}

EdgePrediction::EdgePrediction(const LatticeTarget& target, Face face, const Image<Ray>& rays,
                               const PixelWindow& window)
    : target_(target),
      pattern_(target, face),
      rays_(rays),
      window_(window),
      width_(std::max(0, window.right - window.left)) {
    hits_.resize(std::size_t(width_) * std::size_t(std::max(0, window.bottom - window.top)));
}

void EdgePrediction::compute(const Pose& camera_from_face, const BackgroundDepth& background,
                             const EdgeParams& params, double board_reach_m, double mixed_m) {
    const Pose face_from_camera = inverse(camera_from_face);
    eye_ = face_from_camera.translation;
    face_from_camera_ = face_from_camera.rotation;
    face_depth_m_ = camera_from_face.translation.z;
    params_ = params;
    background_factor_ = std::exp(params.log_background);
    light_ = background.light(face_depth_m_);
    for (int i = 0; i < 4; ++i)
        beyond_m_[std::size_t(i)] = background.beyond(i, face_depth_m_);
    for (int i = 0; i < FacePattern::cell_count; ++i)
        through_m_[std::size_t(i)] = background.through(i, face_depth_m_);
    board_reach_m_ = board_reach_m;
    mixed_m_ = mixed_m;
    std::size_t i = 0;
    for (int y = window_.top; y < window_.bottom; ++y)
        for (int x = window_.left; x < window_.right; ++x)
            hits_[i++] = hit(rays_.view().row(y)[x]);
}

EdgePrediction::Hit EdgePrediction::hit(Ray ray) const {
    if (ray.x == no_ray)
        return {};
    // One metre of depth along the ray.
    const Vec3 d = rotate(face_from_camera_, {ray.x, ray.y, 1});
    const double z = -eye_.z / d.z;
    const double per_length = 1 / length(d);
    const auto surface = [&](double depth, double along_normal) {
        return Hit{float(depth), float(std::abs(along_normal) * per_length / (depth * depth))};
    };
    const double u = eye_.x + d.x * z, v = eye_.y + d.y * z;
    const FacePattern::Inside front = pattern_.inside(u, v);
    const bool on_outline = front.outline > -params_.outline_growth_m;
    const bool in_hole = front.hole > params_.hole_growth_m;
    if (on_outline && !in_hole)
        return surface(z, d.z);
    // Light and depth where the ray meets a wall, `share` of the way to the back face.
    const double deeper = -target_.thickness_m / d.z;
    const double back_u = u + d.x * deeper, back_v = v + d.y * deeper;
    const auto wall = [&](double share, bool across_u) {
        return surface(z + deeper * share, across_u ? d.x : d.y);
    };
    if (in_hole) {
        const int cell = pattern_.nearest_cell(u, v);
        const Rect& drawn = pattern_.cell_at(cell);
        const double g = params_.hole_growth_m;
        const auto leaves = [](double from, double to, double low, double high) {
            return to > high  ? (high - from) / (to - from)
                   : to < low ? (low - from) / (to - from)
                              : 2.0;
        };
        const double by_u = leaves(u, back_u, drawn.left + g, drawn.right - g);
        const double by_v = leaves(v, back_v, drawn.bottom + g, drawn.top - g);
        if (std::min(by_u, by_v) <= 1)
            return wall(std::min(by_u, by_v), by_u < by_v);
        return {float(through_m_[std::size_t(cell)]),
                float(light_.cells[std::size_t(cell)] * background_factor_)};
    }
    const Rect r = outline(target_);
    const double g = params_.outline_growth_m;
    const auto enters = [](double from, double to, double low, double high) {
        if (from < low)
            return to > low ? (low - from) / (to - from) : 2.0;
        if (from > high)
            return to < high ? (high - from) / (to - from) : 2.0;
        return 0.0;
    };
    const double by_u = enters(u, back_u, r.left - g, r.right + g);
    const double by_v = enters(v, back_v, r.bottom - g, r.top + g);
    if (std::max(by_u, by_v) <= 1)
        return wall(std::max(by_u, by_v), by_u > by_v);
    const auto side = std::size_t(pattern_.side_beyond(u, v));
    return {float(beyond_m_[side]), float(light_.outline[side] * background_factor_)};
}

double EdgePrediction::shown(int x, int y) const {
    if (x < window_.left + 2 || y < window_.top + 2 || x + 2 >= window_.right ||
        y + 2 >= window_.bottom)
        return 0.5;
    const Hit* own =
        &hits_[std::size_t(y - window_.top) * std::size_t(width_) + std::size_t(x - window_.left)];
    float nearest = 1e9f, farthest = 0;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const float depth = own[j * width_ + i].depth_m;
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
    if (nearest == 0)
        return 0.5;
    const float middle = (nearest + farthest) / 2;
    float light[2] = {}, sum[2] = {};
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const Hit& h = own[j * width_ + i];
            const float weight = weights[j + 2] * weights[i + 2] * h.light;
            const int far = h.depth_m > middle;
            light[far] += weight;
            sum[far] += weight * h.depth_m;
        }
    const int stronger = light[1] > light[0];
    const float surface = sum[stronger] / light[stronger];
    float pull = 0;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            const Hit& h = own[j * width_ + i];
            pull +=
                weights[j + 2] * weights[i + 2] * h.light *
                std::clamp(h.depth_m - surface, -float(farthest_pull_m), float(farthest_pull_m));
        }
    pull /= light[0] + light[1];
    if (std::abs(pull) > float(given_up_m))
        return 0.5;
    const double z = double(surface + pull);
    const Ray ray = rays_.view().row(y)[x];
    const double face_z = -eye_.z / rotate(face_from_camera_, {ray.x, ray.y, 1}).z;
    const double behind = (z / face_z - 1) * eye_.z;
    // board_reach_m_ contains the tolerance at depth 0; this pixel needs that of its own depth.
    const double shared = board_reach_m_ + plane_tolerance_m(z) - plane_tolerance_m(0);
    return behind < shared ? 1 : behind < shared + mixed_m_ ? 0.5 : 0;
}

}  // namespace theatron::registration
