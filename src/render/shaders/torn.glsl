// SPDX-License-Identifier: Apache-2.0
// Decides for a fragment of mesh.vert's triangles whether it belongs to no surface.

bool is_torn(ivec3 cell, vec2 grid_place, float support) {
    vec2 inside = grid_place - vec2(cell.xy);
    int triangle = inside.x >= inside.y ? 1 : 2;
    // At an outline the grid makes stairs; this contour cuts off their tips.
    const float least_support = 0.6;
    return (cell.z & triangle) == 0 || support < least_support;
}
