// SPDX-License-Identifier: Apache-2.0
// The opacity of a point: less than 1 at the borders of a person, and while cameras fade in
// or out. Needs cloud.glsl.

// 0 to 1. `point` is in the depth camera's frame.
float share_within_cut(vec3 point) {
    vec4 keep = camera.keep, from = camera.remove_from;
    vec4 to = camera.remove_to;
    float border = max(to.w, 1e-3), share = 1.0;
    if (keep.w > 0.0)
        share = 1.0 - smoothstep(keep.w - border, keep.w, distance(point, keep.xyz));
    if (from.w > 0.0) {
        vec3 line = to.xyz - from.xyz, offset = point - from.xyz;
        float along = clamp(dot(offset, line) / max(dot(line, line), 1e-9), 0.0, 1.0);
        share *= smoothstep(from.w, from.w + border, distance(offset, along * line));
    }
    return share;
}

float share_shown(vec3 point) {
    return share_within_cut(point) * camera.color_gain.w;
}
