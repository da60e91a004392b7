// SPDX-License-Identifier: Apache-2.0
// The measured surface, minus the constant offset of its camera. Needs cloud.glsl.

// Metres, 0 where there is none.
float surface_m(ivec2 pixel) {
    float z = depth_m(pixel);
    return z > 0.0 ? z - camera.depth.z : 0.0;
}
