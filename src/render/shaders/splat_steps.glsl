// SPDX-License-Identifier: Apache-2.0
// The places of a point's neighbours in the picture. Needs neighbours.glsl.

uniform int columns;        // of the depth image
uniform vec2 half_picture;  // half of its size in pixels

// Columns: from the point to its right and lower neighbour on the surface, in
// picture pixels; `clip` is the point's own place.
mat2 picture_steps(mat2x3 steps, vec4 clip) {
    mat4 m = camera.clip_from_camera;
    vec4 right = clip + m * vec4(steps[0], 0.0);
    vec4 below = clip + m * vec4(steps[1], 0.0);
    vec2 here = clip.xy / clip.w;
    return mat2((right.xy / right.w - here) * half_picture,
                (below.xy / below.w - here) * half_picture);
}
