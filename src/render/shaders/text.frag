// SPDX-License-Identifier: Apache-2.0

uniform sampler2D distances;  // 0.5 at the outline, more inside
uniform vec3 color;

in vec2 v_in_atlas;

void main() {
    float d = texture(distances, v_in_atlas).r - 0.5;
    float blur = max(fwidth(d), 1e-4);
    float share = clamp(d / blur + 0.5, 0.0, 1.0);
    if (share == 0.0)
        discard;
    write_surface(color, 1.0 / gl_FragCoord.w);
    out_color.a = share;
}
