// SPDX-License-Identifier: Apache-2.0
// The simplest drawing of a depth image as a surface: the yardstick for the times of
// the other renderers.

uniform int columns;  // of the depth image

out vec2 v_place;  // colour pixel

void main() {
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    vec3 point = point_at(pixel, depth_m(pixel));
    gl_Position = camera.clip_from_camera * vec4(point, 1.0);
    v_place = color_pixel(point).xy;
}
