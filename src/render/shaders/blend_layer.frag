// SPDX-License-Identifier: Apache-2.0
// One camera's mesh into a layer of its own: its colour, and how good it is there.

in vec4 v_place;
in float v_support;
in float v_quality;
flat in ivec4 v_cell;

layout(location = 0) out vec4 out_color;

void main() {
    if (is_torn(v_cell, v_place.zw, v_support))
        discard;
    // The square root keeps small weights apart in 8 bits; 0 means nothing is here.
    float weight = clamp(sqrt(v_quality), 2.0 / 255.0, 1.0);
    out_color = vec4(color_at(v_cell.z, v_place.xy), weight);
}
