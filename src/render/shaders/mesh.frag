// SPDX-License-Identifier: Apache-2.0

in vec4 v_place;
in float v_support;
in float v_share;
flat in ivec3 v_cell;

void main() {
    if (is_torn(v_cell, v_place.zw, v_support) || is_faded(v_share))
        discard;
    write_surface(color_at(v_place.xy), 1.0 / gl_FragCoord.w);
}
