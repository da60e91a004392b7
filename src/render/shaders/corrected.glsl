// SPDX-License-Identifier: Apache-2.0
// The surface as it was measured, without what its camera always measures too much. Needs cloud.glsl.

// Metres, 0 where there is none.
float surface_m(int camera, ivec2 pixel) {
    float z = depth_m(camera, pixel);
    return z > 0.0 ? z - cameras[camera].depth_image.w : 0.0;
}
