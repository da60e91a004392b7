// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_edges.h"

#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

using namespace mixed_light;
constexpr double own_width = 1;

}  // namespace

PixelBlur::PixelBlur(Vec2 direction) {
    constexpr double weights[5] = {second_light, next_light, 1 - 2 * (next_light + second_light),
                                   next_light, second_light};
    for (std::size_t k = 0; k < below_.size(); ++k) {
        const double t = -reach + double(k) * step;
        double sum = 0;
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j) {
                const double middle = (i - 2) * direction.x + (j - 2) * direction.y;
                sum +=
                    weights[i] * weights[j] * std::clamp((t - middle) / own_width + 0.5, 0.0, 1.0);
            }
        below_[k] = sum;
    }
}

double PixelBlur::below(double t) const {
    const double at = (t + reach) / step;
    if (at <= 0)
        return 0;
    const auto k = std::size_t(at);
    if (k + 1 >= below_.size())
        return 1;
    return below_[k] + (below_[k + 1] - below_[k]) * (at - double(k));
}

double apparent_edge_px(const PixelBlur& blur, const EdgeLight& light, const EdgeReach& reach) {
    struct Pixel {
        double near = 0, wall = 0, far = 0;  // light
        double far_share() const { return far / (near + far + 1e-9); }
    };
    // A pixel whose middle lies `x` outside of the face's edge.
    const auto pixel = [&](double x) {
        const double face = blur.below(-x), board = blur.below(light.wall_px - x);
        const double wall = light.wall * (board - face);
        return Pixel{face + wall, wall, light.background * (1 - board)};
    };
    const auto shows_board = [&](double x) {
        const Pixel p = pixel(x);
        const double pull = farthest_pull_m * p.far_share();
        // The wall lies behind the face, on the average by half of the thickness.
        const double behind = p.near > 0 ? reach.thickness_m * p.wall / p.near / 2 : 0;
        return pull < given_up_m && pull * reach.cos_face + behind < reach.board_m;
    };
    const auto shows_background = [&](double x) {
        return farthest_pull_m * (1 - pixel(x).far_share()) < given_up_m;
    };
    // The place where `inside` stops to hold, or starts.
    const auto where = [&](const auto& holds, bool inside) {
        double low = -3, high = 3 + light.wall_px;
        for (int i = 0; i < 14; ++i) {
            const double middle = (low + high) / 2;
            (holds(middle) == inside ? low : high) = middle;
        }
        return (low + high) / 2;
    };
    return (where(shows_board, true) + where(shows_background, false)) / 2;
}

struct SeenEdges::Viewpoint {
    Vec3 eye, ahead;  // ahead: the camera's axis
    double pitch, thickness_m, board_reach_m;
    PixelBlur along_u, along_v;
};

SeenEdges::SeenEdges(const LatticeTarget& target, Face face, const Pose& camera_from_face,
                     double pitch, double board_reach_m, const BackgroundLight& background,
                     double log_background)
    : pattern_(target, face), log_background_(log_background) {
    const Pose& pose = camera_from_face;
    const Vec3 middle = pose.translation;
    // How the picture of the middle moves along an axis of the face.
    const auto in_picture = [&](Vec3 axis) {
        const Vec3 a = rotate(pose.rotation, axis);
        return Vec2{a.x - middle.x / middle.z * a.z, a.y - middle.y / middle.z * a.z};
    };
    const auto across = [](Vec2 line) {
        const double n = std::hypot(line.x, line.y);
        return PixelBlur({-line.y / n, line.x / n});
    };
    const Viewpoint from{inverse(pose).translation,
                         rotate(conjugate(pose.rotation), {0, 0, 1}),
                         pitch,
                         target.thickness_m,
                         board_reach_m,
                         across(in_picture({0, 1, 0})),
                         across(in_picture({1, 0, 0}))};
    const double factor = std::exp(log_background);
    const auto scaled = [&](std::array<double, 4> light) {
        for (double& l : light)
            l *= factor;
        return light;
    };
    outline_ = seen(outline(target), false, from, scaled(background.outline));
    for (int i = 0; i < FacePattern::cell_count; ++i) {
        const double light = background.cells[std::size_t(i)];
        if (pattern_.is_hole(i))
            cells_[std::size_t(i)] =
                seen(pattern_.cell_at(i), true, from, scaled({light, light, light, light}));
    }
}

SeenEdges::Sides SeenEdges::seen(const Rect& drawn, bool is_hole, const Viewpoint& from,
                                 const std::array<double, 4>& light) {
    const Vec3 eye = from.eye;
    const std::array<double, 4> near{drawn.left, drawn.bottom, drawn.right, drawn.top};
    const Vec3 middle{(drawn.left + drawn.right) / 2, (drawn.bottom + drawn.top) / 2, 0};
    Sides sides;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool along_u = i % 2 == 0;
        const Vec3 place = along_u ? Vec3{near[i], middle.y, 0} : Vec3{middle.x, near[i], 0};
        const Vec3 line = place - eye;
        const double across = along_u ? line.x : line.y;
        const double distance = length(line);
        const double pixel_m =
            from.pitch * distance / std::sqrt(1 - across * across / (distance * distance));
        // The far face's edge, seen through the near face. +1: the board lies on the lower side.
        const double wall = across * from.thickness_m / (eye.z + from.thickness_m);
        const double sign = (i < 2) == is_hole ? 1 : -1;
        const double wall_m = std::max(0.0, -sign * wall);
        // The face's own light here.
        const double cos_face = eye.z / distance, depth = dot(line, from.ahead);
        const double per_face = depth * depth / cos_face;
        const auto place_with = [&](double background) {
            return near[i] + sign * pixel_m *
                                 apparent_edge_px(along_u ? from.along_u : from.along_v,
                                                  {wall_m / pixel_m, std::abs(across) / eye.z,
                                                   background * per_face},
                                                  {from.board_reach_m, cos_face, from.thickness_m});
        };
        constexpr double step = 0.2;
        sides.place[i] = place_with(light[i]);
        sides.by_background[i] = (place_with(light[i] * std::exp(step)) - sides.place[i]) / step;
    }
    return sides;
}

void SeenEdges::add(const Sides& sides, bool is_hole, double u, double v, double ramp_u,
                    double ramp_v, const EdgeParams& params, Coverage& sum) const {
    const double outward = is_hole ? -1 : 1;  // of the board
    const double growth = outward * (is_hole ? params.hole_growth_m : params.outline_growth_m);
    const double brighter = params.log_background - log_background_;
    std::array<double, 4> covered, slope;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool along_u = i % 2 == 0;
        const double place = sides.place[i] + sides.by_background[i] * brighter;
        const double at = along_u ? u : v;
        const double distance = (i < 2 ? at - place : place - at) + growth;
        const double width = along_u ? ramp_u : ramp_v;
        const double x = 0.5 + distance / width;
        if (x <= 0)
            return;
        covered[i] = std::min(x, 1.0);
        slope[i] = x < 1 ? 1 / width : 0;
    }
    const double across = covered[0] * covered[2], up = covered[1] * covered[3];
    // Derivative of the share when a side moves outwards.
    const std::array<double, 4> gain{
        outward * slope[0] * covered[2] * up, outward * slope[1] * covered[3] * across,
        outward * slope[2] * covered[0] * up, outward * slope[3] * covered[1] * across};
    sum.share += outward * across * up;
    sum.by_u += gain[0] - gain[2];
    sum.by_v += gain[1] - gain[3];
    sum.by_params[is_hole ? 1 : 0] += outward * (gain[0] + gain[1] + gain[2] + gain[3]);
    for (std::size_t i = 0; i < 4; ++i)
        sum.by_params[2] += (i < 2 ? -1 : 1) * gain[i] * sides.by_background[i];
}

Coverage SeenEdges::at(double u, double v, double ramp_u, double ramp_v,
                       const EdgeParams& params) const {
    Coverage sum;
    add(outline_, false, u, v, ramp_u, ramp_v, params, sum);
    // Bars are wider than any ramp, so no other hole is near.
    const int i = pattern_.nearest_cell(u, v);
    if (pattern_.is_hole(i))
        add(cells_[std::size_t(i)], true, u, v, ramp_u, ramp_v, params, sum);
    return sum;
}

}  // namespace theatron::registration
