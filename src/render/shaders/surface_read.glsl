// SPDX-License-Identifier: Apache-2.0
// Reads the properties of a depth pixel that surface.frag wrote. Needs cloud.glsl.

uniform usampler2D surfaces;

struct Surface {
    float z;        // metres; borrowed from a neighbour where nothing was measured
    vec2 shift;     // how far beside the pixel's middle its vertex is, in pixels
    vec2 color;     // colour pixel
    int kept;       // triangles of the cell to the lower right: 1 upper, 2 lower
    float support;  // how many neighbours are connected, 1: all
    float seen;     // as in color_place.glsl
    float quality;  // for blending, without what depends on the view
};

Surface surface_at(ivec2 pixel) {
    uvec4 texel = texelFetch(surfaces, pixel, 0);
    Surface s;
    s.z = uintBitsToFloat(texel.x);
    s.shift = vec2(float((texel.z >> 18) & 15u), float((texel.z >> 22) & 15u)) / 4.0 - 2.0;
    s.color = (unpackUnorm2x16(texel.y) * 2.0 - 0.5) * camera.color_image.xy;
    s.kept = int(texel.z & 3u);
    s.support = float((texel.z >> 2) & 255u) / 255.0;
    s.seen = float((texel.z >> 10) & 255u) / 255.0;
    s.quality = float(texel.w) / 65535.0;
    return s;
}
