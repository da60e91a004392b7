// SPDX-License-Identifier: Apache-2.0
#include "furniture/baked_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "furniture/pieces.h"
#include "image/srgb.h"

namespace theatron::furniture {
namespace {

constexpr double pi = std::numbers::pi;
// Light from directions without furniture, and the share that furniture reflects.
constexpr double ceiling_light = 1.62, wall_light = 1.06, floor_light = 0.78, bounced_light = 0.16;
constexpr double exposure = 1.25;
constexpr double around_reach_m = 1.6;
// Strengths at a distance of one metre.
constexpr double panel_strength = 1.7, lamp_strength = 5.0;
constexpr double corner_share = 0.34, corner_m = 0.2;

double light_from(Vec3 d) {
    const double up = d.y > 0 ? ceiling_light : floor_light, share = std::abs(d.y);
    return wall_light * (1 - share) + up * share;
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

bool has(const std::vector<Piece>& pieces, std::string_view name) {
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const Piece& piece) { return piece.name == name; });
}

}  // namespace

BakedLight::BakedLight(const Extent& extent) : extent_(extent), voxels_(extent) {}

BakedLight::BakedLight(const Extent& extent, const std::vector<Piece>& pieces)
    : BakedLight(extent) {
    while (!step(pieces)) {
    }
}

bool BakedLight::step(const std::vector<Piece>& pieces) {
    if (pieces_done_ == pieces.size())
        return voxels_.finish_step();
    has_panel_ = has(pieces, "ceiling panel");
    has_lamps_ = has(pieces, "table lamps");
    const Piece& piece = pieces[pieces_done_++];
    for (const Model::Part& part : piece.model.parts)
        voxels_.add(part.mesh, piece.room_from_piece);
    return false;
}

double BakedLight::from_around(Vec3 place, Vec3 n) const {
    const Vec3 side = normalized(cross(std::abs(n.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n));
    const Vec3 other = cross(n, side);
    // A surface must not hide its own light.
    const Vec3 from = place + n * (1.3 * voxels_.cell_m());
    const double lift = voxels_.cell_m();
    // One cone along the normal and five around it cover the half sphere (Crassin et al. 2011).
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
        const double angle = 2 * pi * i / 5;
        const Vec3 d =
            i == 5 ? n
                   : n * 0.5 + (side * std::cos(angle) + other * std::sin(angle)) * std::sqrt(0.75);
        const double open = voxels_.open_share(from, d, 0.577, around_reach_m, lift);
        sum += (i == 5 ? 0.25 : 0.15) * (open * light_from(d) + (1 - open) * bounced_light);
    }
    return sum;
}

double BakedLight::from_lamps(Vec3 place, Vec3 n) const {
    const Vec3 from = place + n * (1.3 * voxels_.cell_m());
    const double lift = voxels_.cell_m();
    double sum = 0;
    const auto add = [&](Vec3 lamp, double radius, double strength, Vec3 along, double from_slope,
                         double to_slope) {
        const Vec3 to_lamp = lamp - place;
        const double distance = length(to_lamp);
        const Vec3 d = to_lamp * (1 / distance);
        const double facing = dot(n, d), ahead = -dot(d, along);
        if (facing <= 0 || ahead <= 0)
            return;
        const double slope = std::sqrt(std::max(0.0, 1 - ahead * ahead)) / ahead;
        const double beam = 1 - smooth_step(from_slope, to_slope, slope);
        if (beam <= 0)
            return;
        // Ends before the lamp's own housing.
        const double open = voxels_.open_share(from, d, radius / distance, distance - 0.22, lift);
        sum += strength * facing * beam * open / std::max(0.5, distance * distance);
    };
    if (has_panel_)
        for (const double x : {-0.6, 0.6})
            for (const double z : {-0.6, 0.6})
                add({x, extent_.height - 0.05, z}, 0.6, panel_strength, {0, -1, 0}, 1.2, 4);
    if (has_lamps_)
        for (const Vec3 lamp : lamp_places)
            add(lamp, 0.25, lamp_strength, normalized(lamp_target - lamp), 0.18, 0.42);
    return sum;
}

double BakedLight::open_corner(Vec3 p, Vec3 n) const {
    const Extent& e = extent_;
    const struct {
        double distance;
        Vec3 inwards;
    } planes[] = {{p.x - e.left, {1, 0, 0}}, {e.right - p.x, {-1, 0, 0}},
                  {p.z - e.back, {0, 0, 1}}, {e.front - p.z, {0, 0, -1}},
                  {p.y, {0, 1, 0}},          {e.height - p.y, {0, -1, 0}}};
    double open = 1;
    for (const auto& plane : planes)
        if (dot(plane.inwards, n) < 0.7)
            open *= 1 - corner_share * std::exp(-std::max(0.0, plane.distance) / corner_m);
    return open;
}

double BakedLight::at(Vec3 place, Vec3 normal) const {
    return exposure *
           (from_around(place, normal) * open_corner(place, normal) + from_lamps(place, normal));
}

Rgb shown(Vec3 light) {
    // The curve takes longer than all else: a table of it, in steps of the square root.
    constexpr int steps = 2048;
    constexpr double most = 6;
    static const auto curve = [] {
        std::array<std::uint8_t, steps + 1> values{};
        for (int i = 0; i <= steps; ++i) {
            const double root = double(i) / steps, c0 = most * root * root;
            const double c = std::min(1.0, c0 * (1 + c0 / 6) / (1 + c0));
            values[std::size_t(i)] = std::uint8_t(std::lround(255 * linear_to_srgb(c)));
        }
        return values;
    }();
    const auto value = [&](double c) {
        const double root = std::sqrt(std::clamp(c / most, 0.0, 1.0));
        return curve[std::size_t(root * steps + 0.5)];
    };
    return {value(light.x), value(light.y), value(light.z)};
}

void append_baked(render::MeshData& all, const Piece& piece, const BakedLight& light) {
    for (const Model::Part& part : piece.model.parts) {
        const render::SurfaceLook look = look_of(part.material);
        const std::size_t first = all.vertices.size();
        append_at(all, part.mesh, piece.room_from_piece);
        for (std::size_t i = first; i < all.vertices.size(); ++i) {
            const auto& v = all.vertices[i];
            const Vec3 n{v.nx, v.ny, v.nz};
            if (shines(part.material)) {
                const Vec3 c = look.base_color * 255;
                all.colors.push_back({std::uint8_t(c.x), std::uint8_t(c.y), std::uint8_t(c.z)});
                continue;
            }
            double falling = light.at({v.px, v.py, v.pz}, n);
            // Metal shows its surroundings: brighter above, darker below.
            if (look.metallic > 0.5)
                falling *= 0.56 + 0.36 * n.y;
            all.colors.push_back(shown(look.base_color * falling));
        }
    }
}

render::MeshData baked_mesh(const std::vector<Piece>& pieces, const BakedLight& light) {
    render::MeshData all;
    for (const Piece& piece : pieces)
        append_baked(all, piece, light);
    return all;
}

}  // namespace theatron::furniture
