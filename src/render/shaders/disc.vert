// SPDX-License-Identifier: Apache-2.0
// Splats that lie in their surface: ellipses in the picture, with the depth of the
// surface at each of their pixels. Where splats overlap, this depth decides which one is
// seen, not the order in which they are drawn.

uniform float point_size;  // 1: without gaps

flat out float v_share;
flat out vec3 v_place;    // colour pixel, diameter
flat out vec3 v_ellipse;  // a, b, c of a x^2 + b x y + c y^2 <= 1, in picture pixels
flat out vec4 v_plane;    // distance at the centre, its change to the right, upwards; how much
                          // further back it is tested

void main() {
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    float z = depth_m(pixel);
    vec3 point = point_at(pixel, z);
    mat4 m = camera.clip_from_camera;
    vec4 clip = m * vec4(point, 1.0);
    v_share = share_shown(point);
    if (z == 0.0 || point.x > 1e6 || clip.w <= 0.0 || v_share == 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the picture
        gl_PointSize = 1.0;
        return;
    }
    mat2x3 steps = surface_steps(pixel, point);
    mat2 j = picture_steps(steps, clip);

    // The image of a circle in the grid of pixels, widened so that it always meets a
    // pixel's centre.
    float radius = 0.75 * point_size;
    const float widening = 0.3;
    mat2 q = radius * radius * (j * transpose(j)) + mat2(widening);
    float determinant_q = determinant(q);
    v_ellipse = vec3(q[1][1], -2.0 * q[0][1], q[0][0]) / determinant_q;
    gl_PointSize = clamp(2.0 * sqrt(max(q[0][0], q[1][1])), 1.0, 64.0);

    vec2 change = vec2((m * vec4(steps[0], 0.0)).w, (m * vec4(steps[1], 0.0)).w);
    float determinant_j = determinant(j);
    // Seen edge on, a disc has no slope that means anything.
    vec2 slope = abs(determinant_j) > 0.1 ? inverse(transpose(j)) * change : vec2(0.0);
    vec3 color = color_place(point);
    v_plane = vec4(clip.w, slope, set_back_m(color.z));
    gl_Position = clip;
    v_place = vec3(color.xy, gl_PointSize);
}
