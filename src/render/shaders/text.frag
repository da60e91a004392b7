// SPDX-License-Identifier: Apache-2.0

uniform sampler2D distances;  // 0.5 at the outline, more inside
uniform vec3 color;

in vec2 v_in_atlas;

void main() {
    float d = texture(distances, v_in_atlas).r - 0.5;
    float blur = max(fwidth(d), 1e-4);
    float share = clamp(d / blur + 0.5, 0.0, 1.0);
    // Bright letters have a dark rim, so that they are read before bright walls.
    float bright = step(0.4, dot(color, vec3(0.2, 0.7, 0.1)));
    float rim = bright * 0.75 * smoothstep(-0.36, -0.12, d);
    float opacity = max(share, rim);
    if (opacity == 0.0)
        discard;
    write_surface(color * mix(1.0, share, bright), 1.0 / gl_FragCoord.w);
    out_color.a = opacity;
}
