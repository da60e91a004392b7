// SPDX-License-Identifier: Apache-2.0

flat in vec4 v_place;
flat in float v_share;

void main() {
    // Small ones are no rounder for it.
    if (v_place.w > 2.5 && distance(gl_PointCoord, vec2(0.5)) > 0.5)
        discard;
    if (is_faded(v_share))
        discard;
    write_surface(color_at(int(v_place.z), v_place.xy), 1.0 / gl_FragCoord.w);
}
