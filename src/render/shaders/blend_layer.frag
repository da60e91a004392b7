// SPDX-License-Identifier: Apache-2.0
// Draws one camera's mesh into a separate layer: its colour, and its quality there.


in vec4 v_place;
in float v_support;
in float v_share;
in float v_quality;
flat in ivec3 v_cell;

layout(location = 0) out vec4 out_color;

// The mean over the picture's pixel, which may cover several of the camera's. Beyond the
// colour picture the colours at its border go on, the more blurred the further away. Four
// samples either way: software drivers pay for all branches.
vec3 color_of_pixel(vec2 pixel) {
    vec2 size = camera.color_image.xy;
    vec2 place = pixel + 0.5;
    vec2 a = 0.25 * dFdx(pixel), b = 0.25 * dFdy(pixel);
    vec2 outside = max(max(-place, place - size), vec2(0.0));
    float beyond = max(outside.x, outside.y);
    if (beyond > 0.0) {
        vec2 along = outside.x > outside.y ? vec2(0.0, beyond) : vec2(beyond, 0.0);
        a = 0.4 * along;
        b = 0.15 * along;
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 corner = place + ((i & 1) == 0 ? a : -a) + ((i & 2) == 0 ? b : -b);
        sum += texture(color_picture, corner / size).rgb;
    }
    return size.x == 0.0 ? color_of_unseen : 0.25 * sum;
}

void main() {
    if (is_torn(v_cell, v_place.zw, v_support) || is_faded(v_share))
        discard;
    // The square root keeps small weights apart in 8 bits. 0 means nothing is here, 1 that
    // it is seen from behind: the grid's triangles run clockwise for their own camera.
    float weight = gl_FrontFacing ? 1.0 / 255.0 : clamp(sqrt(v_quality), 2.0 / 255.0, 1.0);
    out_color = vec4(color_of_pixel(v_place.xy) * camera.color_gain.rgb, weight);
}
