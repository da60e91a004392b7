// SPDX-License-Identifier: Apache-2.0
// Closed surfaces out of fields of samples.
//
// Marching tetrahedra over Kuhn's split of each cell into six (Doi and Koide 1991; Kuhn 1960):
// neighbouring tetrahedra share whole faces, so that the surface is closed and manifold for any
// samples. Pure functions.
#pragma once

#include <functional>
#include <span>

#include "medical/mesh.h"
#include "medical/volume.h"

namespace theatron::medical {

// One layer of a field, that of `slice`, into columns * rows values: negative inside.
using FieldLayer = std::function<void(int slice, std::span<float> out)>;

// The surface where the field changes its sign, interpolated linearly. The field's outermost
// samples count as outside, whatever they are, so that the surface is closed; it turns outwards
// and has no normals yet. Stops at `max_triangles` and gives nothing then. Memory: two layers.
Mesh isosurface(const VolumeGrid& grid, const FieldLayer& field,
                std::size_t max_triangles = max_mesh_triangles);

}  // namespace theatron::medical
