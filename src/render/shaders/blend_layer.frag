// SPDX-License-Identifier: Apache-2.0
// One camera's mesh into a layer of its own: its colour, and how good it is there.

in vec4 v_place;
in float v_support;
in float v_share;
in float v_quality;
flat in ivec4 v_cell;

layout(location = 0) out vec4 out_color;

// The mean over the picture's pixel, which may cover several of the camera's.
vec3 color_of_pixel(int camera, vec2 place) {
    vec2 dx = 0.25 * dFdx(place), dy = 0.25 * dFdy(place);
    if (dot(dx, dx) + dot(dy, dy) < 0.125)
        return color_at(camera, place);
    return 0.25 * (color_at(camera, place + dx + dy) + color_at(camera, place + dx - dy) +
                   color_at(camera, place - dx + dy) + color_at(camera, place - dx - dy));
}

void main() {
    if (is_torn(v_cell, v_place.zw, v_support) || is_faded(v_share))
        discard;
    // The square root keeps small weights apart in 8 bits. 0 means nothing is here, 1 that
    // it is seen from behind: the grid's triangles run clockwise for their own camera.
    float weight = gl_FrontFacing ? 1.0 / 255.0 : clamp(sqrt(v_quality), 2.0 / 255.0, 1.0);
    out_color = vec4(color_of_pixel(v_cell.z, v_place.xy) * cameras[v_cell.z].color_gain.rgb, weight);
}
