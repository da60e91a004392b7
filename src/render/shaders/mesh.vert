// SPDX-License-Identifier: Apache-2.0
// The depth image as a grid of triangles, torn where it jumps and where it has holes.
//
// A vertex decides for the two triangles of the cell to its lower right, of
// which it is the provoking (last) corner: the upper one with its right and its
// diagonal neighbour, the lower one with its diagonal neighbour and the one below. The
// fragment shader throws the torn ones away. GLES 3.0 has no other place for
// it: vertices are shared, and there are no geometry shaders.

uniform int columns;       // of the depth images
uniform int first_camera;  // of those drawn by this call
uniform bool sets_back;    // whether set_back.glsl is asked

out vec4 v_place;       // colour pixel, place in the depth image
out float v_support;    // how many neighbours are connected, 1: all
out float v_quality;    // for blending; see quality.glsl
flat out ivec4 v_cell;  // corner of the cell, camera, kept triangles: 1 upper, 2 lower

bool connected(float z1, float z2, float limit) {
    return z1 > 0.0 && z2 > 0.0 && abs(z1 - z2) < limit;
}

// For a pixel without depth: that of any neighbour. Triangles at a hole's border are
// thrown away, but until then they are to be small.
float borrowed_depth(int camera, ivec2 pixel) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            float z = depth_near(camera, pixel, ivec2(dx, dy));
            if (z > 0.0)
                return z;
        }
    // The camera's own place, where all triangles inside a hole collapse.
    return 0.0;
}

void main() {
    int camera = first_camera + gl_InstanceID;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    float z = depth_m(camera, pixel);
    int kept = 0;
    vec2 steepness = vec2(0.0);
    v_support = 0.0;
    if (z > 0.0) {
        float right = depth_near(camera, pixel, ivec2(1, 0));
        float below = depth_near(camera, pixel, ivec2(0, 1));
        float diagonal = depth_near(camera, pixel, ivec2(1, 1));
        float left = depth_near(camera, pixel, ivec2(-1, 0));
        float above = depth_near(camera, pixel, ivec2(0, -1));
        float straight = largest_step(footprint_m(camera, z));
        float oblique = 1.4142 * straight;
        bool to_right = connected(z, right, straight);
        bool to_below = connected(z, below, straight);
        bool to_diagonal = connected(z, diagonal, oblique);
        if (to_diagonal && to_right && connected(right, diagonal, straight))
            kept = 1;
        if (to_diagonal && to_below && connected(below, diagonal, straight))
            kept += 2;
        float other_diagonals =
            float(connected(z, depth_near(camera, pixel, ivec2(-1, -1)), oblique)) +
            float(connected(z, depth_near(camera, pixel, ivec2(1, -1)), oblique)) +
            float(connected(z, depth_near(camera, pixel, ivec2(-1, 1)), oblique));
        float straights = float(to_right) + float(to_below) + float(connected(z, left, straight)) +
                          float(connected(z, above, straight));
        v_support = (2.0 * straights + float(to_diagonal) + other_diagonals) / 12.0;
        float footprint = footprint_m(camera, z);
        steepness.x = (to_right ? right - z : z - left) / footprint;
        steepness.y = (to_below ? below - z : z - above) / footprint;
    } else {
        z = borrowed_depth(camera, pixel);
    }
    vec3 point = point_at(camera, pixel, z);
    vec3 color = color_place(camera, point);
    gl_Position = cameras[camera].clip_from_camera * vec4(point, 1.0);
    if (sets_back)
        gl_Position = set_back(gl_Position, color.z);
    v_place = vec4(color.xy, vec2(pixel));
    v_quality = quality_at(camera, pixel, point, steepness, color.z);
    v_cell = ivec4(pixel, camera, kept);
}
