// SPDX-License-Identifier: Apache-2.0
// A colour picture that follows its noise slowly. Needs cloud.glsl.

uniform bool has_before;
uniform sampler2D colors_before;  // this shader's output for the previous frame

layout(location = 0) out vec4 out_color;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    vec3 color = texelFetch(color_picture, place, 0).rgb;
    vec3 before = texelFetch(colors_before, place, 0).rgb;
    vec3 change = abs(color - before);
    // The noise of sensor and compression has a deviation of two to four steps of 255.
    float changed = smoothstep(8.0 / 255.0, 18.0 / 255.0, max(change.r, max(change.g, change.b)));
    out_color = vec4(has_before ? mix(before, color, mix(0.15, 1.0, changed)) : color, 1.0);
}
