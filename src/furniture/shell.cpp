// SPDX-License-Identifier: Apache-2.0
#include "furniture/shell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace theatron::furniture {
namespace {

using render::MeshData;

constexpr double cove_m = 0.08;  // radius of the curve between floor and walls
constexpr int cove_steps = 4;
constexpr double panel_m = 1.2, joint_m = 0.008;
constexpr double rail_low_m = 0.98, rail_high_m = 1.12;
constexpr double skirting_m = 0.12;
constexpr double tile_m = 0.6;
constexpr double light_step_m = 0.1;
// A step of this size takes some milliseconds, also in a browser.
constexpr int points_at_once = 1000, pixels_at_once = 100'000;

// The frame of a side: its picture's left upper corner, and the edges along u and v.
struct Frame {
    Vec3 corner, along, down, inwards;
    double width = 0, height = 0;
};

Frame frame_of(const Extent& e, Side side) {
    const double w = e.right - e.left, d = e.front - e.back, h = e.height;
    switch (side) {
        case Side::floor:
            return {{e.left, 0, e.back}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, w, d};
        case Side::ceiling:
            return {{e.left, h, e.front}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, w, d};
        case Side::back:
            return {{e.left, h, e.back}, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, w, h};
        case Side::front:
            return {{e.right, h, e.front}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, w, h};
        case Side::left:
            return {{e.left, h, e.front}, {0, 0, -1}, {0, -1, 0}, {1, 0, 0}, d, h};
        case Side::right:
            return {{e.right, h, e.back}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}, d, h};
    }
    return {};
}

bool is_wall(Side side) {
    return side != Side::floor && side != Side::ceiling;
}

Size picture_size(Side side) {
    return side == Side::floor ? Size{768, 768} : is_wall(side) ? Size{1024, 256} : Size{512, 512};
}

// From 0 to 1, without any pattern.
double random_at(int x, int y, unsigned seed) {
    unsigned h = unsigned(x) * 0x9e3779b1u ^ unsigned(y) * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    h ^= h >> 15;
    return h * (1 / 4294967296.0);
}

Vec3 mixed(Vec3 a, Vec3 b, double share) {
    return a * (1 - share) + b * share;
}

// The share of a picture element of this size at `x` that a line of this width around multiples of
// `distance` covers.
double line_share(double x, double distance, double width, double texel) {
    const double off = std::abs(x - distance * std::round(x / distance));
    return std::clamp((width / 2 + texel / 2 - off) / texel, 0.0, std::min(1.0, width / texel));
}

// Brighter and darker flecks, each in a cell of its own.
double fleck(double x, double z, double cell, unsigned seed) {
    const int i = int(std::floor(x / cell)), k = int(std::floor(z / cell));
    const double kind = random_at(i, k, seed);
    if (kind > 0.55)
        return 0;
    const double u = x / cell - i - 0.3 - 0.4 * random_at(i, k, seed + 1),
                 v = z / cell - k - 0.3 - 0.4 * random_at(i, k, seed + 2);
    const double radius = 0.16 + 0.2 * random_at(i, k, seed + 3);
    if (u * u + v * v > radius * radius)
        return 0;
    const double inside = std::min((radius - std::sqrt(u * u + v * v)) / 0.12, 1.0);
    return (kind < 0.3 ? 1 : -1) * inside;
}

const Vec3 vinyl{0.135, 0.205, 0.225};

Vec3 floor_color(Vec3 p, double texel) {
    // A zone of another tint below the ceiling panel, with a border.
    const double zone = std::max(std::abs(p.x) - 1.9, std::abs(p.z) - 1.65);
    Vec3 c = mixed(vinyl, {0.165, 0.265, 0.27}, std::clamp(0.5 - zone / texel, 0.0, 1.0));
    c = c * (1 - 0.3 * std::clamp((0.02 + texel / 2 - std::abs(zone)) / texel, 0.0, 1.0));
    c = c * (1 + 0.16 * fleck(p.x, p.z, 0.052, 1) + 0.12 * fleck(p.x + 7.3, p.z - 2.1, 0.031, 9));
    const double seam =
        std::max(line_share(p.x, 1, 0.005, texel), line_share(p.z, 1, 0.005, texel));
    return c * (1 - 0.35 * seam);
}

// Hills in the distance, printed on the panels.
Vec3 landscape(double along, double up) {
    const Vec3 sky =
        mixed({0.66, 0.80, 0.86}, {0.40, 0.64, 0.82}, std::clamp((up - 1.7) / 1.3, 0.0, 1.0));
    Vec3 c = sky;
    for (int i = 0; i < 4; ++i) {
        const double top = 2.02 - 0.24 * i + 0.11 * std::sin(along * (0.9 + 0.45 * i) + 1.7 * i) +
                           0.05 * std::sin(along * (2.3 + 0.6 * i) + 0.6 * i);
        const Vec3 hill = mixed({0.50, 0.68, 0.72}, {0.20, 0.42, 0.24}, i / 3.0);
        c = mixed(c, hill, std::clamp((top - up) / (0.03 + 0.012 * i), 0.0, 1.0) * 0.92);
    }
    return c;
}

Vec3 wall_color(Side side, double along, double up, double texel_x, double texel_y) {
    const auto from = [&](double y) { return std::clamp((up - y) / texel_y + 0.5, 0.0, 1.0); };
    const Vec3 above = side == Side::left ? landscape(along, up) : Vec3{0.76, 0.78, 0.76};
    const Vec3 below{0.38, 0.57, 0.53};
    Vec3 c = mixed(below, above, from(rail_high_m));
    c = mixed(c, {0.78, 0.79, 0.78}, side == Side::left ? from(2.62) : 0);
    const double joint = line_share(along, panel_m, joint_m, texel_x) * from(skirting_m);
    c = c * (1 - 0.45 * joint);
    // A rail of oak, which beds and carts may hit.
    const double rail = from(rail_low_m) * (1 - from(rail_high_m));
    const double grain = 0.06 * std::sin(43 * up * 6 + 2.2 * std::sin(along * 1.7));
    c = mixed(c, Vec3{0.46, 0.31, 0.18} * (1 + grain), rail);
    for (const double y : {rail_low_m, rail_high_m})
        c = c * (1 - 0.3 * std::clamp((0.5 * joint_m + texel_y / 2 - std::abs(up - y)) / texel_y,
                                      0.0, 1.0));
    return mixed(vinyl, c, from(skirting_m));
}

Vec3 ceiling_color(Vec3 p, double texel) {
    const double joint =
        std::max(line_share(p.x, tile_m, 0.012, texel), line_share(p.z, tile_m, 0.012, texel));
    return Vec3{0.82, 0.83, 0.82} * (1 - 0.3 * joint);
}

std::uint8_t encoded(double c) {
    return std::uint8_t(std::lround(255 * std::pow(std::clamp(c, 0.0, 1.0), 1 / 2.2)));
}

}  // namespace

MeshData side_mesh(const Extent& e, Side side) {
    const Frame f = frame_of(e, side);
    MeshData mesh;
    const auto row = [&](double off, double v, Vec3 n) {
        for (const double u : {0.0, 1.0}) {
            const Vec3 p =
                f.corner + f.along * (u * f.width) + f.down * (v * f.height) + f.inwards * off;
            mesh.vertices.push_back({float(p.x), float(p.y), float(p.z), float(n.x), float(n.y),
                                     float(n.z), float(u), float(v)});
        }
    };
    row(0, 0, f.inwards);
    if (!is_wall(side)) {
        row(0, 1, f.inwards);
    } else {
        for (int i = 0; i <= cove_steps; ++i) {
            const double angle = std::numbers::pi / 2 * i / cove_steps;
            const Vec3 n = f.inwards * std::cos(angle) + Vec3{0, std::sin(angle), 0};
            row(cove_m * (1 - std::cos(angle)), 1 - cove_m * (1 - std::sin(angle)) / f.height, n);
        }
    }
    for (std::uint32_t i = 0; i + 3 < mesh.vertices.size(); i += 2)
        mesh.indices.insert(mesh.indices.end(), {i, i + 2, i + 3, i, i + 3, i + 1});
    return mesh;
}

SidePicture::SidePicture(const Extent& extent, Side side, const BakedLight* light)
    : extent_(extent), side_(side), light_(light), image_(picture_size(side)) {
    const Frame f = frame_of(extent, side);
    if (light)
        grid_.resize({std::max(2, int(f.width / light_step_m)) + 1,
                      std::max(2, int(f.height / light_step_m)) + 1});
}

bool SidePicture::step() {
    if (lit_rows_ < grid_.size.height)
        light_points();
    else
        paint_rows();
    return painted_rows_ == image_.size.height;
}

void SidePicture::light_points() {
    const Frame f = frame_of(extent_, side_);
    const int columns = grid_.size.width - 1, rows = grid_.size.height - 1;
    const int end = std::min(lit_rows_ + points_at_once / (columns + 1) + 1, rows + 1);
    for (int& j = lit_rows_; j < end; ++j)
        for (int i = 0; i <= columns; ++i) {
            const double u = f.width * i / columns, v = f.height * j / rows;
            grid_.view().row(j)[i] = float(
                light_->at(f.corner + f.along * u + f.down * v + f.inwards * 0.001, f.inwards));
        }
}

double SidePicture::lightness(int x, int y) const {
    const double gx = (x + 0.5) / image_.size.width * (grid_.size.width - 1),
                 gy = (y + 0.5) / image_.size.height * (grid_.size.height - 1);
    const int i = int(gx), j = int(gy);
    const double a = gx - i, b = gy - j;
    const auto row0 = grid_.view().row(j), row1 = grid_.view().row(j + 1);
    return (row0[i] * (1 - a) + row0[i + 1] * a) * (1 - b) +
           (row1[i] * (1 - a) + row1[i + 1] * a) * b;
}

void SidePicture::paint_rows() {
    const Frame f = frame_of(extent_, side_);
    const Size size = image_.size;
    const double tx = f.width / size.width, ty = f.height / size.height;
    const double texel = std::max(tx, ty);
    const int end = std::min(painted_rows_ + pixels_at_once / size.width + 1, size.height);
    for (int& y = painted_rows_; y < end; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double u = (x + 0.5) * tx, v = (y + 0.5) * ty;
            const Vec3 p = f.corner + f.along * u + f.down * v;
            // Joints count from the wall's middle.
            const Vec3 c = side_ == Side::floor ? floor_color(p, texel)
                           : side_ == Side::ceiling
                               ? ceiling_color(p, texel)
                               : wall_color(side_, u - f.width / 2, p.y, tx, ty);
            image_.view().row(y)[x] =
                light_ ? shown(c * lightness(x, y)) : Rgb{encoded(c.x), encoded(c.y), encoded(c.z)};
        }
}

double roughness_of(Side side) {
    return side == Side::floor ? 0.5 : is_wall(side) ? 0.6 : 0.9;
}

}  // namespace theatron::furniture
