// SPDX-License-Identifier: Apache-2.0

uniform vec2 origin;    // of the picture in its target, pixels
uniform float outline;  // pixels around the piece
uniform vec4 ink;       // with opacity

flat in vec4 v_ends;
flat in vec2 v_radii;
flat in vec2 v_distances;
flat in vec2 v_behind;

void main() {
    vec2 from_start = gl_FragCoord.xy - origin - v_ends.xy, along = v_ends.zw - v_ends.xy;
    float reach = length(along);
    along = reach > 1e-3 ? along / reach : vec2(1.0, 0.0);
    float walked = dot(from_start, along), t = clamp(walked / max(reach, 1e-3), 0.0, 1.0);
    float radius = reach > 1e-3 ? mix(v_radii.x, v_radii.y, t) : max(v_radii.x, v_radii.y);
    float outside = length(from_start - along * (t * reach)) - radius;
    // The base of an arrow's head is flat.
    if (v_radii.y == 0.0 && reach > 1e-3)
        outside = max(outside, -walked);
    float share = clamp(0.5 - (outside - outline), 0.0, 1.0);
    // The place between the ends in the room, not in the picture.
    float near_end = t / v_distances.y, near_start = (1.0 - t) / v_distances.x;
    float in_room = near_end / (near_start + near_end);
    if (share == 0.0 || mix(v_behind.x, v_behind.y, in_room) > 0.0)
        discard;
    write_surface(ink.rgb, 1.0 / (near_start + near_end));
    out_color.a = share * ink.a;
}
