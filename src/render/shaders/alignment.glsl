// SPDX-License-Identifier: Apache-2.0
// The weight of a camera for this view. Needs cloud.glsl.

// A camera that sees the point from the viewer's direction has the
// right colours.
float alignment(vec3 point) {
    vec3 from_viewer = point - camera.viewer.xyz;
    float aligned = max(dot(normalize(point), normalize(from_viewer)), 0.1);
    return aligned * aligned;
}
