// SPDX-License-Identifier: Apache-2.0
// The outline of a surface in a plane: where a slice cuts an organ. Pure functions.
#pragma once

#include <vector>

#include "medical/mesh.h"

namespace theatron::medical {

struct Segment {
    Vec3 a, b;
};

// The line segments in which triangles cut the plane through `point` with this `normal` (of any
// length, not 0). The segments of a closed surface join to closed lines.
std::vector<Segment> cut_mesh(const Mesh& mesh, Vec3 point, Vec3 normal);

}  // namespace theatron::medical
