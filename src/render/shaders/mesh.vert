// SPDX-License-Identifier: Apache-2.0
// The depth image as a grid of triangles, torn where it jumps and where it has holes.
//
// A vertex decides for the two triangles of the cell to its lower right, of
// which it is the provoking (last) corner: the upper one with its right and its
// diagonal neighbour, the lower one with its diagonal neighbour and the one below. The
// fragment shader throws the torn ones away. GLES 3.0 has no other place for
// it: vertices are shared, and there are no geometry shaders.

uniform int columns;  // of the depth images

out vec4 v_place;     // colour pixel, place in the depth image
flat out ivec4 v_cell;  // corner of the cell, camera, kept triangles: 1 upper, 2 lower

// Depth beside the image is that of its border: cells there do not exist.
float depth_near(int camera, ivec2 pixel, ivec2 offset) {
    ivec2 last = textureSize(depth_images, 0).xy - 1;
    return depth_m(camera, clamp(pixel + offset, ivec2(0), last));
}

// Whether two neighbouring pixels, `apart` pixels from each other, lie on one surface.
// The limit grows with the distance as the pixels' footprint does: it stands for an
// angle at which the surface is seen, about 5 degrees, beyond some sensor noise.
bool connected(int camera, float z1, float z2, float apart) {
    const float noise_m = 0.012;
    const float slope = 12.0;
    float footprint = min(z1, z2) * cameras[camera].depth_image.z * apart;
    return z1 > 0.0 && z2 > 0.0 && abs(z1 - z2) < noise_m + slope * footprint;
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
    int camera = gl_InstanceID;
    ivec2 pixel = ivec2(gl_VertexID % columns, gl_VertexID / columns);
    float z = depth_m(camera, pixel);
    int kept = 0;
    if (z > 0.0) {
        float right = depth_near(camera, pixel, ivec2(1, 0));
        float below = depth_near(camera, pixel, ivec2(0, 1));
        float diagonal = depth_near(camera, pixel, ivec2(1, 1));
        if (connected(camera, z, diagonal, 1.4142)) {
            if (connected(camera, z, right, 1.0) && connected(camera, right, diagonal, 1.0))
                kept = 1;
            if (connected(camera, z, below, 1.0) && connected(camera, below, diagonal, 1.0))
                kept += 2;
        }
    } else {
        z = borrowed_depth(camera, pixel);
    }
    vec3 point = point_at(camera, pixel, z);
    gl_Position = cameras[camera].clip_from_camera * vec4(point, 1.0);
    v_place = vec4(color_pixel(camera, point), vec2(pixel));
    v_cell = ivec4(pixel, camera, kept);
}
