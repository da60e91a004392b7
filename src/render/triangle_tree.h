// SPDX-License-Identifier: Apache-2.0
// The nearest of many triangles along a ray: a tree of boxes, each of whose halves holds half of
// the triangles (median split along the longest side; Möller and Trumbore 1997 for one triangle).
//
// Pure: no GL.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/vec.h"

namespace theatron::render {

class TriangleTree {
public:
    struct Triangle {
        Vec3 a, b, c;
    };
    struct Hit {
        double distance = 0;  // in lengths of the ray's direction
        Vec3 normal;  // unit length, towards the side where the corners run counter-clockwise
    };

    explicit TriangleTree(std::vector<Triangle> triangles);

    // The nearest triangle at distances above 0, seen from either side.
    std::optional<Hit> nearest(Vec3 from, Vec3 direction) const;

private:
    // A box around triangles [first, first + count). Its halves are the next node and `second`.
    struct Node {
        Vec3 low, high;
        std::uint32_t first = 0, count = 0;
        std::uint32_t second = 0;  // 0: a leaf
    };
    void build(std::uint32_t first, std::uint32_t count);

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace theatron::render
