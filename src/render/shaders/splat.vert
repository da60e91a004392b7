// SPDX-License-Identifier: Apache-2.0
// One point for each depth pixel (gl_VertexID), as large in the picture as the gaps to its
// neighbours: that follows from its distance and the density of points there.

uniform float pixels_per_tan;  // of the picture, at its centre
uniform float point_size;      // 1: without gaps

flat out vec3 v_place;  // colour pixel, diameter
flat out float v_share;

void main() {
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    float z = depth_m(pixel);
    vec3 point = point_at(pixel, z);
    vec4 clip = camera.clip_from_camera * vec4(point, 1.0);
    v_share = share_shown(point);
    if (z == 0.0 || point.x > 1e6 || clip.w <= 0.0 || v_share == 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the picture
        gl_PointSize = 1.0;
        return;
    }
    mat2 steps = picture_steps(surface_steps(pixel, point), clip);
    // Round points of this diameter leave no gap between four neighbours; below 2, a
    // point covers no neighbour's pixel in the camera's own picture.
    const float overlap = 1.5;
    // Where a surface is steep a round point as wide as the gap would stand out from it.
    float upright = footprint_m(z) * pixels_per_tan / clip.w;
    float gap = min(max(length(steps[0]), length(steps[1])), 3.0 * upright);
    vec3 color = color_place(point);
    gl_Position = set_back(clip, color.z);
    gl_PointSize = clamp(gap * overlap * point_size, 1.0, 64.0);
    v_place = vec3(color.xy, gl_PointSize);
}
