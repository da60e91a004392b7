// SPDX-License-Identifier: Apache-2.0
// The distance of each block from the next edge of the surface: 0 at the edge, 1 from about
// ten depth pixels on. The input is the map that edges.frag drew.

uniform sampler2D whole;
uniform sampler2D distances_before;  // this shader's output for the previous frame
uniform bool has_before;

layout(location = 0) out vec4 out_distance;

void main() {
    const float reach = 2.5;  // blocks
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(whole, 0) - 1;
    float nearest = reach;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            ivec2 place = here + ivec2(x, y);
            bool inside = all(greaterThanEqual(place, ivec2(0))) && all(lessThanEqual(place, last));
            if (!inside || texelFetch(whole, place, 0).r < 0.5)
                nearest = min(nearest, length(vec2(x, y)));
        }
    float distance = nearest / reach;
    // Gaps that come and go would make the cameras' weights flicker.
    if (has_before)
        distance = mix(texelFetch(distances_before, here, 0).r, distance, 0.25);
    out_distance = vec4(distance);
}
