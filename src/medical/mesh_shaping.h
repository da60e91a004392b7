// SPDX-License-Identifier: Apache-2.0
// From raw triangles to surfaces for drawing: weld, smooth, restore the volume, simplify.
//
// Pure functions. None computes normals; call compute_normals() at the end.
#pragma once

#include "medical/mesh.h"

namespace theatron::medical {

// Joins vertices with equal positions and leaves out triangles without area and vertices that no
// triangle has. STL files have three vertices of their own for each triangle.
void weld(Mesh& mesh);

// Smooths without shrinking much: Taubin's lambda|mu filter (1995) with equal weights. The
// topology does not change; vertices on open edges are not moved.
void smooth(Mesh& mesh, int rounds);

// Moves the surface in or out along its normals until the enclosed volume is `volume_mm3`. For
// closed surfaces; those of a few triangles may miss it.
void restore_volume(Mesh& mesh, double volume_mm3);

// Reduces the mesh to about `max_triangles` by collapsing edges, those first that change the
// surface least (quadric error metrics, Garland and Heckbert 1997). Manifold surfaces stay
// manifold; open edges are not changed, so more triangles than that may remain.
void simplify(Mesh& mesh, std::size_t max_triangles);

}  // namespace theatron::medical
