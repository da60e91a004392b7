// SPDX-License-Identifier: Apache-2.0

in vec4 v_place;
flat in ivec4 v_cell;

void main() {
    vec2 inside = v_place.zw - vec2(v_cell.xy);
    int triangle = inside.x >= inside.y ? 1 : 2;
    if ((v_cell.w & triangle) == 0)
        discard;
    write_surface(color_at(v_cell.z, v_place.xy), 1.0 / gl_FragCoord.w);
}
