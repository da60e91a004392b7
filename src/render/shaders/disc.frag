// SPDX-License-Identifier: Apache-2.0

uniform vec2 depth_from_w;  // window depth of distance w: x + y / w

flat in float v_share;
flat in vec3 v_place;
flat in vec3 v_ellipse;
flat in vec4 v_plane;

void main() {
    // The point's own axes: x to the right, y up, as in clip coordinates.
    vec2 d = (gl_PointCoord - 0.5) * vec2(v_place.z, -v_place.z);
    float rim = dot(v_ellipse, vec3(d.x * d.x, d.x * d.y, d.y * d.y));
    if (rim > 1.0 || is_faded(v_share))
        discard;
    float w = max(v_plane.x + dot(v_plane.yz, d), 0.001);
    // Where discs of one surface overlap, the one whose centre is nearer shows.
    gl_FragDepth = depth_from_w.x + depth_from_w.y / (w * (1.0 + 0.001 * rim) + v_plane.w);
    write_surface(color_at(v_place.xy), w);
}
