// SPDX-License-Identifier: Apache-2.0

flat in vec3 v_place;
flat in float v_share;

void main() {
    // Small ones are no rounder for it.
    if (v_place.z > 2.5 && distance(gl_PointCoord, vec2(0.5)) > 0.5)
        discard;
    if (is_faded(v_share))
        discard;
    write_surface(color_at(v_place.xy), 1.0 / gl_FragCoord.w);
}
