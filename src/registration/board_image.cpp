// SPDX-License-Identifier: Apache-2.0
#include "registration/board_image.h"

#include <array>
#include <cmath>
#include <limits>

namespace theatron::registration {
namespace {

using Axis3 = std::array<double, 3>;

struct Box {
    Axis3 least, largest;
};

// Where a line enters and leaves a box: parameter and axis of the side it passes through.
struct Crossing {
    double enters = -std::numeric_limits<double>::infinity();
    double leaves = std::numeric_limits<double>::infinity();
    int enters_by = 0, leaves_by = 0;
    bool hits() const { return enters < leaves; }
};

Crossing cross_box(const Box& box, const Axis3& origin, const Axis3& direction) {
    Crossing c;
    for (int i = 0; i < 3; ++i) {
        const auto k = std::size_t(i);
        double a = (box.least[k] - origin[k]) / direction[k];
        double b = (box.largest[k] - origin[k]) / direction[k];
        if (a > b)
            std::swap(a, b);
        if (a > c.enters) {
            c.enters = a;
            c.enters_by = i;
        }
        if (b < c.leaves) {
            c.leaves = b;
            c.leaves_by = i;
        }
    }
    return c;
}

}  // namespace

BoardHit hit_board(const LatticeTarget& target, const Pose& board_from_camera, Ray ray) {
    const Vec3 d = rotate(board_from_camera.rotation, {ray.x, ray.y, 1});
    const Vec3 o = board_from_camera.translation;
    const Axis3 origin{o.x, o.y, o.z}, direction{d.x, d.y, d.z};
    const auto box_of = [&](const Rect& r) {
        return Box{{r.left, r.bottom, -target.thickness_m}, {r.right, r.top, 0}};
    };
    const auto hit = [&](double depth, int axis) {
        return BoardHit{float(depth), float(std::abs(direction[std::size_t(axis)]) / length(d))};
    };
    const Crossing board = cross_box(box_of(outline(target)), origin, direction);
    if (!board.hits() || board.enters <= 0)
        return {};
    constexpr int through_face = 2;
    if (board.enters_by != through_face)
        return hit(board.enters, board.enters_by);
    const double u = o.x + d.x * board.enters, v = o.y + d.y * board.enters;
    for (const Rect& hole : holes(target, Face::front)) {
        if (u < hole.left || u > hole.right || v < hole.bottom || v > hole.top)
            continue;
        const Crossing inside = cross_box(box_of(hole), origin, direction);
        if (inside.leaves_by == through_face)
            return {};
        return hit(inside.leaves, inside.leaves_by);
    }
    return hit(board.enters, through_face);
}

Image<BoardHit> board_image(const LatticeTarget& target, const Pose& camera_from_board,
                            const Image<Ray>& rays) {
    Image<BoardHit> image(rays.size);
    const Pose board_from_camera = inverse(camera_from_board);
    for (std::size_t i = 0; i < rays.pixels.size(); ++i)
        if (rays.pixels[i].x != no_ray)
            image.pixels[i] = hit_board(target, board_from_camera, rays.pixels[i]);
    return image;
}

}  // namespace theatron::registration
