// SPDX-License-Identifier: Apache-2.0
// The surface as it was measured. Needs cloud.glsl.

// Metres, 0 where there is none.
float surface_m(ivec2 pixel) {
    return depth_m(pixel);
}

// See refined.glsl.
const float goes_on_behind = 0.0;
