// SPDX-License-Identifier: Apache-2.0
// A rectangle of the picture, which begins at the origin.

uniform mat4 clip_from_picture;
uniform vec2 plate;  // its width and height, pixels

out vec2 v_place;  // pixels from its upper left corner

void main() {
    v_place = plate * vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = clip_from_picture * vec4(v_place, 0.0, 1.0);
}
