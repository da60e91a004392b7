// SPDX-License-Identifier: Apache-2.0

in vec4 v_place;
in float v_support;
flat in ivec4 v_cell;

void main() {
    vec2 inside = v_place.zw - vec2(v_cell.xy);
    int triangle = inside.x >= inside.y ? 1 : 2;
    // At an outline the grid makes stairs; this contour cuts off their tips.
    const float least_support = 0.6;
    if ((v_cell.w & triangle) == 0 || v_support < least_support)
        discard;
    write_surface(color_at(v_cell.z, v_place.xy), 1.0 / gl_FragCoord.w);
}
