// SPDX-License-Identifier: Apache-2.0
// Where cameras overlap, points with a colour of their own win over points without one.

uniform vec2 depth_from_w;  // window depth of distance w: x + y / w

// How much further back a point is tested than it is, in metres. `seen` as in color_place.glsl.
float set_back_m(float seen) {
    return 0.03 * (1.0 - seen);
}

// `clip` with that much more depth, in the same place of the picture.
vec4 set_back(vec4 clip, float seen) {
    clip.z -= 2.0 * depth_from_w.y * set_back_m(seen) / clip.w;
    return clip;
}
