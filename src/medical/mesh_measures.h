// SPDX-License-Identifier: Apache-2.0
// Volume, area and topology of a surface: closed, manifold, neither. Pure functions.
#pragma once

#include "medical/mesh.h"
#include "medical/volume.h"

namespace theatron::medical {

struct MeshShape {
    bool closed = false;    // each edge has one triangle on either side, or several such pairs
    bool manifold = false;  // closed, each edge has two triangles, each vertex one fan of them
    double volume_mm3 = 0;  // inside a closed surface; negative if that is inside out
    double area_mm2 = 0;
};
MeshShape shape_of(const Mesh& mesh);

// The box around all positions; empty at the origin without any.
Box box_of(const Mesh& mesh);
bool overlap(const Box& a, const Box& b);

}  // namespace theatron::medical
