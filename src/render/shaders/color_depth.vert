// SPDX-License-Identifier: Apache-2.0
// Draws a camera's depth from its colour camera's viewpoint, depth only: the map
// that color_place.glsl reads. A point for each block of 2x2 depth pixels.

uniform int blocks_per_row;
uniform vec2 map_size;

void main() {
    ivec2 pixel = 2 * ivec2(gl_VertexID % blocks_per_row, gl_VertexID / blocks_per_row);
    float z = 0.0;
    for (int i = 0; i < 4; ++i) {
        float depth = depth_m(pixel + ivec2(i & 1, i >> 1));
        if (depth > 0.0 && (z == 0.0 || depth < z))
            z = depth;
    }
    vec3 seen_at = color_pixel(point_at(pixel, z));
    vec2 size = camera.color_image.xy;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    if (z == 0.0 || seen_at.z <= 0.0)
        return;
    // Blocks meet in the map: what is seen is closed, and a little larger than it is.
    float pixels_per_tan = camera.color_pinhole.x * map_size.x / size.x;
    float block_tan = 2.0 * camera.depth.y * z / seen_at.z;
    gl_PointSize = clamp(1.25 * block_tan * pixels_per_tan + 0.5, 1.0, 16.0);
    vec2 place = (seen_at.xy + 0.5) / size;
    gl_Position = vec4(2.0 * place - 1.0, 2.0 * seen_at.z / farthest_m - 1.0, 1.0);
}
