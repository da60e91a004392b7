// SPDX-License-Identifier: Apache-2.0
// The surface as it was measured, without what its camera always measures too much. Needs cloud.glsl.

// Metres, 0 where there is none.
float surface_m(ivec2 pixel) {
    float z = depth_m(pixel);
    return z > 0.0 ? z - camera.depth.z : 0.0;
}
