// SPDX-License-Identifier: Apache-2.0
// Computes all properties of a depth pixel that do not depend on the view, once for each new
// image. The vertex shaders of every view only read them (surface_read.glsl).


layout(location = 0) out uvec4 out_surface;

bool connected(float z1, float z2, float limit) {
    return z1 > 0.0 && z2 > 0.0 && abs(z1 - z2) < limit;
}

// For a pixel without depth: that of any neighbour. Triangles at a hole's border are
// thrown away, but until then they are to be small. Without any it is the camera's own
// place, where all triangles inside a hole collapse.
float borrowed_depth(float neighbours[8]) {
    for (int i = 0; i < 8; ++i)
        if (neighbours[i] > 0.0)
            return neighbours[i];
    return 0.0;
}

// True if the next pixel with depth along `direction` hides the continuation of this surface, which is not
// connected to the next pixel.
bool hidden_beyond(ivec2 pixel, ivec2 direction, float z, float next, float limit) {
    if (next == 0.0)
        next = surface_near(pixel, 2 * direction);
    return next > 0.0 && next < z - limit;
}

// Towards what hides this surface along `axis`: -1, 0 or 1.
float hidden_side(ivec2 pixel, ivec2 axis, float before, float z, float after, float limit) {
    if (connected(before, z, limit))
        return hidden_beyond(pixel, axis, z, after, limit) ? 1.0 : 0.0;
    return connected(z, after, limit) && hidden_beyond(pixel, -axis, z, before, limit) ? -1.0 : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = surface_m(pixel);
    float above = surface_near(pixel, ivec2(0, -1));
    float left = surface_near(pixel, ivec2(-1, 0));
    float right = surface_near(pixel, ivec2(1, 0));
    float below = surface_near(pixel, ivec2(0, 1));
    float diagonal = surface_near(pixel, ivec2(1, 1));
    float up_left = surface_near(pixel, ivec2(-1, -1));
    float up_right = surface_near(pixel, ivec2(1, -1));
    float down_left = surface_near(pixel, ivec2(-1, 1));
    uint kept = 0u;
    float support = 0.0;
    vec2 steepness = vec2(0.0);
    vec2 hidden = vec2(0.0);
    if (z > 0.0) {
        float footprint = footprint_m(z);
        float straight = largest_step(footprint);
        float oblique = 1.4142 * straight;
        bool to_right = connected(z, right, straight);
        bool to_below = connected(z, below, straight);
        bool to_diagonal = connected(z, diagonal, oblique);
        if (to_diagonal && to_right && connected(right, diagonal, straight))
            kept = 1u;
        if (to_diagonal && to_below && connected(below, diagonal, straight))
            kept += 2u;
        float straights = float(to_right) + float(to_below) + float(connected(z, left, straight)) +
                          float(connected(z, above, straight));
        float diagonals = float(to_diagonal) + float(connected(z, up_left, oblique)) +
                          float(connected(z, up_right, oblique)) +
                          float(connected(z, down_left, oblique));
        support = (2.0 * straights + diagonals) / 12.0;
        steepness.x = (to_right ? right - z : z - left) / footprint;
        steepness.y = (to_below ? below - z : z - above) / footprint;
        if (goes_on_behind > 0.0)
            hidden = vec2(hidden_side(pixel, ivec2(1, 0), left, z, right, straight),
                          hidden_side(pixel, ivec2(0, 1), above, z, below, straight));
    } else {
        z = borrowed_depth(
            float[8](left, right, above, below, up_left, up_right, down_left, diagonal));
    }
    vec3 point = point_at(pixel, z);
    vec3 color = color_place(point);
    float quality = quality_at(pixel, point, steepness, color.z);
    vec2 place = color.xy / max(camera.color_image.xy, vec2(1.0));
    // A hidden surface exists all the same, and the next camera's shadow may begin where this one's ends.
    // Its continuation may fall back at its slope, but never rises in front of other cameras' surfaces.
    vec2 shift = goes_on_behind * hidden;
    z += max(dot(shift, steepness), 0.0) * footprint_m(z);
    out_surface.x = floatBitsToUint(z);
    out_surface.y = packUnorm2x16((place + 0.5) / 2.0);
    uvec2 quarters = uvec2(4.0 * shift + 8.0);
    out_surface.z = kept | (uint(support * 255.0 + 0.5) << 2) |
                    (uint(color.z * 255.0 + 0.5) << 10) | (quarters.x << 18) | (quarters.y << 22);
    out_surface.w = uint(quality * 65535.0 + 0.5);
}
