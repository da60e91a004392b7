// SPDX-License-Identifier: Apache-2.0
// The surface after refine.frag. Needs cloud.glsl.

uniform usampler2D refined_depth;

// Metres, 0 where there is none.
float surface_m(ivec2 pixel) {
    return uintBitsToFloat(texelFetch(refined_depth, pixel, 0).r);
}

// How far a surface continues behind its occluder, in pixels.
const float goes_on_behind = 1.5;
