// SPDX-License-Identifier: Apache-2.0
// Depth for blending: less noise, also over time, and small gaps closed where both sides of a gap lie on one
// surface. Nothing is continued beyond what was measured.

uniform usampler2D refined_before;  // this shader's output for the previous frame
uniform bool has_before;

layout(location = 0) out uint out_depth;

const uint age_bits = 15u;     // of refined depth: frames since it was measured
const int reach = 8;           // pixels, to either side of a gap
const float widest_gap = 9.0;  // pixels, from side to side

// The nearest depth that was measured along `direction`, and how many pixels away; 0, 0: none.
vec2 nearest_along(ivec2 pixel, ivec2 direction) {
    for (int i = 1; i <= reach; ++i) {
        float z = surface_near(pixel, i * direction);
        if (z > 0.0)
            return vec2(z, float(i));
    }
    return vec2(0.0);
}

// Between the two sides of a gap along `axis`: depth, and the gap's width; 0 if there is none.
vec2 across(ivec2 pixel, ivec2 axis) {
    const vec2 none = vec2(0.0, 1e6);
    vec2 after = nearest_along(pixel, axis);
    if (after.x == 0.0)
        return none;
    vec2 before = nearest_along(pixel, -axis);
    float steps = after.y + before.y;
    if (before.x == 0.0 || steps > widest_gap + 1.0)
        return none;
    float width = steps * length(vec2(axis));
    float limit = largest_step(footprint_m(max(after.x, before.x)));
    if (abs(after.x - before.x) > limit * (1.0 + 0.25 * width))
        return none;
    return vec2(mix(before.x, after.x, before.y / steps), width);
}

float filled(ivec2 pixel) {
    vec2 best = vec2(0.0, 1e6);
    for (int i = 0; i < 4; ++i) {
        vec2 line = across(pixel, ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1))[i]);
        if (line.y < best.y)
            best = line;
    }
    return best.x;
}

// Light of two surfaces in one pixel pulls the rim of the nearer one back: there the surface is
// continued as it was before.
float straightened(ivec2 pixel, float z) {
    float footprint = footprint_m(z);
    float limit = largest_step(footprint);
    for (int i = 0; i < 4; ++i) {
        ivec2 outwards = ivec2[4](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1))[i];
        float beyond = surface_near(pixel, outwards);
        if (beyond > 0.0 && beyond < z + limit)
            continue;
        float inner = surface_near(pixel, -outwards);
        float further = surface_near(pixel, -2 * outwards);
        float continued = 2.0 * inner - further;
        if (inner > 0.0 && further > 0.0 && abs(inner - further) < limit &&
            abs(z - inner) < limit && z > continued + 0.004 + 2.0 * footprint)
            return continued;
    }
    return z;
}

// The assumed standard deviation of the sensor's noise. It grows as less light comes back.
float noise_m(float z) {
    return 0.0015 + 0.0008 * z * z;
}

// Refined depth of the previous frame, 0 where there was none. Without its lowest bits; see remembered().
float depth_before(ivec2 pixel) {
    ivec2 last = textureSize(depth_image, 0) - 1;
    return uintBitsToFloat(texelFetch(refined_before, clamp(pixel, ivec2(0), last), 0).r & ~age_bits);
}

// A mean over pairs of opposite neighbours on the same surface, so that slopes and rims keep their places. A
// pair whose mean differs from this pixel has a step in between and gets less weight. Where nothing moved, the
// previous frame decides this, so that noise does not change the decision from frame to frame.
float smoothed(ivec2 pixel, float z) {
    float limit = largest_step(footprint_m(z));
    float noise = noise_m(z);
    float before = has_before ? depth_before(pixel) : 0.0;
    bool stayed = abs(before - z) < 2.0 * noise;
    float sum = 2.0 * z, weight = 2.0;
    for (int i = 0; i < 6; ++i) {
        ivec2 offset = ivec2[6](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1), ivec2(2, 0),
                                ivec2(0, 2))[i];
        float a = surface_near(pixel, offset), b = surface_near(pixel, -offset);
        float w = abs(a - z) < limit && abs(b - z) < limit ? (i < 2 ? 1.5 : i < 4 ? 1.0 : 0.6) : 0.0;
        float step = abs(a + b - 2.0 * z);
        if (stayed)
            step = abs(depth_before(pixel + offset) + depth_before(pixel - offset) - 2.0 * before);
        w *= 1.0 - smoothstep(1.5 * noise, 3.0 * noise, step);
        sum += w * (a + b);
        weight += 2.0 * w;
    }
    return sum / weight;
}

// The number of the eight neighbours that measure this surface now.
int support(float around[8], float z) {
    float limit = largest_step(footprint_m(z));
    int count = 0;
    for (int i = 0; i < 8; ++i)
        count += int(abs(around[i] - z) < limit);
    return count;
}

// The sensor gives no depth where light of two surfaces meets in a pixel: the nearer one
// goes on to about the middle of those. 0 where too few neighbours agree.
float widened(float around[8]) {
    float nearest = 1e6;
    for (int i = 0; i < 8; ++i)
        if (around[i] > 0.0)
            nearest = min(nearest, around[i]);
    if (nearest == 1e6)
        return 0.0;
    float limit = largest_step(footprint_m(nearest));
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < 8; ++i)
        if (abs(around[i] - nearest) < limit) {
            sum += around[i];
            count += 1.0;
        }
    return count >= 2.0 ? sum / count : 0.0;
}

// The lowest bits of refined depth are a state: 0 unchanged, 1 or 2 measured further or nearer than
// before, 3 and more: number of frames without a measurement, plus 2.
const uint went_back = 1u, came_near = 2u, longest_missing = 15u;

uint remembered(float z, uint happened) {
    return (floatBitsToUint(z) & ~age_bits) | happened;
}

// A surface at rest follows its noise slowly. A moving one is taken as measured, but a large step only after
// the next frame confirms it, because depth flutters at edges. Without a measurement the old depth stays
// for some frames. Nothing is kept where the neighbours no longer measure the old surface.
uint steadied(float around[8], float measured, float z) {
    if (!has_before)
        return remembered(z, 0u);
    uint bits = texelFetch(refined_before, ivec2(gl_FragCoord.xy), 0).r;
    float before = uintBitsToFloat(bits & ~age_bits);
    uint happened = bits & age_bits;
    if (before == 0.0)
        return remembered(z, 0u);
    float change = (z - before) / noise_m(z);
    int supporting = support(around, before);
    if (measured == 0.0) {
        if (happened < longest_missing && supporting >= 1)
            return remembered(before, max(happened, came_near) + 1u);
        if (z == 0.0)
            return 0u;
    }
    const float slowly = 0.06;
    uint direction = abs(change) < 2.0 ? 0u : change > 0.0 ? went_back : came_near;
    bool confirmed = happened == direction;
    if (!confirmed && (abs(change) < 12.0 || supporting >= 3))
        return remembered(abs(change) < 12.0 ? mix(before, z, slowly) : before, direction);
    float moved = smoothstep(2.0, 6.0, abs(change));
    return remembered(mix(before, z, mix(slowly, 1.0, moved)), direction);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float around[8];
    for (int i = 0; i < 8; ++i)
        around[i] = surface_near(pixel,
                                 ivec2[8](ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1), ivec2(-1, 0),
                                          ivec2(1, 0), ivec2(-1, 1), ivec2(0, 1), ivec2(1, 1))[i]);
    float measured = surface_m(pixel);
    float z = measured;
    if (measured > 0.0)
        z = smoothed(pixel, straightened(pixel, measured));
    else {
        z = filled(pixel);
        if (z == 0.0)
            z = widened(around);
    }
    out_depth = steadied(around, measured, z);
}
