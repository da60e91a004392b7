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

// Writes the layer of a field at `slice` into columns * rows values: negative inside.
using FieldLayer = std::function<void(int slice, std::span<float> out)>;

// The surface where the field changes its sign, interpolated linearly. The field's outermost
// samples count as outside, whatever their values, so that the surface is closed. Its triangles
// face outwards; it has no normals yet. Empty beyond `max_triangles`. Memory: two layers.
Mesh isosurface(const VolumeGrid& grid, const FieldLayer& field,
                std::size_t max_triangles = max_mesh_triangles);

}  // namespace theatron::medical
