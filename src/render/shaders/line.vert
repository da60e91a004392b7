// SPDX-License-Identifier: Apache-2.0
// A piece of a line as a rectangle of the picture that holds it with its outline. All four corners have the
// same attributes.

uniform mat4 clip_from_line;
uniform vec2 picture;            // pixels
uniform float pixels_per_slope;  // the width of a metre at a distance of one metre
uniform float least_radius;      // pixels
uniform float outline;           // pixels around the piece
uniform float near_m;
uniform vec2 nearer;             // metres, and metres a metre of distance: it is tested as nearer by this distance
uniform vec2 depth_from_w;       // window depth of distance w: x + y / w
uniform vec4 cut;                // normal and distance of the plane behind which nothing is drawn

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 radii;  // of both ends in metres, then in least radii

flat out vec4 v_ends;       // pixels
flat out vec2 v_radii;      // pixels
flat out vec2 v_distances;  // of both ends, metres
flat out vec2 v_behind;     // the cut, metres

void main() {
    vec4 a = clip_from_line * vec4(from, 1.0), b = clip_from_line * vec4(to, 1.0);
    vec2 radii_m = radii.xy;
    v_behind = vec2(dot(cut.xyz, from), dot(cut.xyz, to)) - cut.w;
    if (max(a.w, b.w) <= near_m) {
        v_ends = vec4(0.0);
        v_radii = v_distances = vec2(0.0);
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    // Only the part before the eye has places in the picture.
    float share = min(a.w, b.w) < near_m ? (near_m - a.w) / (b.w - a.w) : 0.0;
    if (a.w < near_m) {
        a = mix(a, b, share);
        radii_m.x = mix(radii_m.x, radii_m.y, share);
        v_behind.x = mix(v_behind.x, v_behind.y, share);
    } else if (b.w < near_m) {
        b = mix(a, b, share);
        radii_m.y = mix(radii_m.x, radii_m.y, share);
        v_behind.y = mix(v_behind.x, v_behind.y, share);
    }
    v_distances = vec2(a.w, b.w);
    v_ends = (vec4(a.xy / a.w, b.xy / b.w) * 0.5 + 0.5) * picture.xyxy;
    v_radii = max(radii_m * pixels_per_slope / v_distances, radii.zw * least_radius);

    vec2 step_to_end = v_ends.zw - v_ends.xy;
    float reach = length(step_to_end);
    vec2 along = reach > 1e-3 ? step_to_end / reach : vec2(1.0, 0.0);
    // An arrow's head far away.
    if (v_radii.y == 0.0 && reach > 1e-3)
        v_ends.xy = v_ends.zw - along * max(reach, 2.0 * v_radii.x);

    bool at_end = (gl_VertexID & 1) == 1;
    float side = (gl_VertexID & 2) == 0 ? -1.0 : 1.0;
    float around = max(v_radii.x, v_radii.y) + outline + 1.0;  // and a pixel for smooth edges
    vec2 corner = (at_end ? v_ends.zw + along * around : v_ends.xy - along * around) +
                  vec2(-along.y, along.x) * side * around;
    float distance_m = at_end ? b.w : a.w;
    float tested = max(distance_m - nearer.x - nearer.y * distance_m, 1.001 * near_m);
    // Without perspective: depth is linear between places of the picture.
    gl_Position = vec4(corner / picture * 2.0 - 1.0, 2.0 * (depth_from_w.x + depth_from_w.y / tested) - 1.0, 1.0);
}
