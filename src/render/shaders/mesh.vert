// SPDX-License-Identifier: Apache-2.0
// The depth image as a grid of triangles, torn where it jumps and where it has holes.
//
// A vertex decides for the two triangles of the cell to its lower right, of
// which it is the provoking (last) corner: the upper one with its right and its
// diagonal neighbour, the lower one with its diagonal neighbour and the one below. The
// fragment shader throws the torn ones away. GLES 3.0 has no other place for
// it: vertices are shared, and there are no geometry shaders.

uniform int columns;    // of the depth image
uniform bool sets_back; // whether set_back.glsl is asked, and cameras fade by themselves

out vec4 v_place;       // colour pixel, place in the depth image
out float v_support;    // how many neighbours are connected, 1: all
out float v_quality;    // for blending; see quality.glsl
out float v_share;      // how much is to be seen
flat out ivec3 v_cell;  // corner of the cell, kept triangles: 1 upper, 2 lower

void main() {
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    Surface s = surface_at(pixel);
    vec3 point = point_at(pixel, s.z);
    point.xy += s.shift * (camera.depth.y * s.z);
    gl_Position = camera.clip_from_camera * vec4(point, 1.0);
    if (sets_back)
        gl_Position = set_back(gl_Position, s.seen);
    v_share = sets_back ? share_shown(point) : share_within_cut(point);
    v_place = vec4(s.color, vec2(pixel));
    v_support = s.support;
    v_quality = s.quality * alignment(point);
    v_cell = ivec3(pixel, s.kept);
}
