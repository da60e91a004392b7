// SPDX-License-Identifier: Apache-2.0

uniform vec2 plate;
uniform vec4 ground;  // with opacity
uniform vec3 edge;
uniform vec2 shape;   // the radius of the corners, the width of the edge: pixels

in vec2 v_place;

void main() {
    vec2 from_middle = abs(v_place - 0.5 * plate) - 0.5 * plate + shape.x;
    float inside = shape.x - length(max(from_middle, 0.0)) - min(max(from_middle.x, from_middle.y), 0.0);
    float share = clamp(inside + 0.5, 0.0, 1.0);
    if (share == 0.0)
        discard;
    float on_edge = clamp(shape.y - inside + 0.5, 0.0, 1.0);
    write_surface(mix(ground.rgb, edge, on_edge), 1.0 / gl_FragCoord.w);
    out_color.a = share * mix(ground.a, 1.0, on_edge);
}
