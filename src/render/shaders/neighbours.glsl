// SPDX-License-Identifier: Apache-2.0
// Decides whether neighbouring pixels lie on one surface. Needs cloud.glsl and measured.glsl or
// refined.glsl.

// Depth beside the image is that of its border: cells there do not exist.
float surface_near(ivec2 pixel, ivec2 offset) {
    ivec2 last = textureSize(depth_image, 0) - 1;
    return surface_m(clamp(pixel + offset, ivec2(0), last));
}

// The side of the square that a pixel covers at distance `z`, in metres.
float footprint_m(float z) {
    return z * camera.depth.y;
}

// The largest step to the next pixel on one surface. It grows with the distance as the
// footprint does, and so stands for an angle: surfaces seen at less than about 8
// degrees are torn. Some sensor noise is always allowed.
float largest_step(float footprint) {
    const float noise_m = 0.012;
    const float slope = 7.0;
    return noise_m + slope * footprint;
}

// The change of depth to the next pixel of the same surface, along `direction`: to the
// one or from the one before, whichever is less, 0 if neither is connected.
float depth_step(ivec2 pixel, float z, ivec2 direction) {
    float next = surface_near(pixel, direction);
    float before = surface_near(pixel, -direction);
    float ahead = next > 0.0 ? next - z : 1e6;
    float behind = before > 0.0 ? z - before : 1e6;
    float smaller = abs(ahead) < abs(behind) ? ahead : behind;
    return abs(smaller) < largest_step(footprint_m(z)) ? smaller : 0.0;
}

// From a point to the next column's on the surface, and to the next row's. Lens
// distortion is neglected: it changes little from one pixel to the next.
mat2x3 surface_steps(ivec2 pixel, vec3 point) {
    float dzx = depth_step(pixel, point.z, ivec2(1, 0));
    float dzy = depth_step(pixel, point.z, ivec2(0, 1));
    vec3 ray = point / point.z;
    float tan_per_pixel = camera.depth.y;
    vec3 to_right = ray * dzx;
    to_right.x += tan_per_pixel * (point.z + dzx);
    vec3 to_below = ray * dzy;
    to_below.y += tan_per_pixel * (point.z + dzy);
    return mat2x3(to_right, to_below);
}
