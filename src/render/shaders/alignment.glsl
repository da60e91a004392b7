// SPDX-License-Identifier: Apache-2.0
// How much a camera is worth for this view. Needs cloud.glsl.

// The camera that looks from where the viewer looks has the
// right colours.
float alignment(vec3 point) {
    vec3 from_viewer = point - camera.viewer.xyz;
    float aligned = max(dot(normalize(point), normalize(from_viewer)), 0.1);
    return aligned * aligned;
}
