// SPDX-License-Identifier: Apache-2.0
// Fading without sorting: a surface with a share below 1 is drawn in that share of its pixels,
// evenly spread (interleaved gradient noise, Jimenez 2014).

bool is_faded(float share) {
    float threshold =
        fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
    return share <= threshold * 0.998 + 0.001;
}
