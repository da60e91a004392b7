// SPDX-License-Identifier: Apache-2.0
// A quarter of the depth image: 1 where a block of 4x4 pixels is whole, 0 where it
// holds a jump or a gap.


layout(location = 0) out vec4 out_whole;

void main() {
    ivec2 corner = 4 * ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(depth_image, 0) - 1;
    bool whole = all(lessThanEqual(corner + 4, last));
    float above[5];
    for (int y = 0; y <= 4 && whole; ++y) {
        float before = 0.0;
        for (int x = 0; x <= 4; ++x) {
            float z = surface_near(corner, ivec2(x, y));
            float step = largest_step(footprint_m(z));
            whole = whole && z > 0.0 && (x == 0 || abs(z - before) < step) &&
                    (y == 0 || abs(z - above[x]) < step);
            before = z;
            above[x] = z;
        }
    }
    out_whole = vec4(whole ? 1.0 : 0.0);
}
