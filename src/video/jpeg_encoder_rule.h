// SPDX-License-Identifier: Apache-2.0
// The arithmetic of our JPEG encoder, shared by its kernels and their reference:
// numbers of 16 bits throughout, products rounded as the vector instructions do.
//
// Samples and coefficients carry fractions. A sample is 4 times its value. Each
// pass of the transform keeps that scale, times the square root of 8; in the end
// a coefficient is 32 times its value and still fits: nothing in here ever
// overflows, whatever the picture.
//
// Luma, and chroma before it is averaged, are nevertheless rounded to whole
// numbers first. Cameras' pictures have mostly been in that form before, and get
// back exactly there, so that this removes more error than it makes.
#pragma once

#include <cassert>
#include <cstdint>
#include <initializer_list>

#include "image/view.h"
#include "video/jpeg_encoder_tables.h"

namespace theatron::video::jpeg {

// a * b / 2^15, rounded.
constexpr int mul15(int a, int b) {
    return (a * b + (1 << 14)) >> 15;
}

// Factors in units of 2^-15.
constexpr std::int16_t in_q15(double factor) {
    return std::int16_t(factor * 32768 + (factor < 0 ? -0.5 : 0.5));
}
// A factor that divides by 2^n.
constexpr std::int16_t halved(int n) {
    return std::int16_t(1 << (15 - n));
}

// Luma from channels of 256 times their value, in units of 2^-16. Each product is
// cut off, which the rounding makes up for.
constexpr std::uint16_t luma_r = 19595, luma_g = 38470, luma_b = 7471;
static_assert(luma_r + luma_g + luma_b == 1 << 16);
constexpr std::uint16_t luma_rounding = 128 + 1;

// The same for chroma; the largest factor of each is one half.
constexpr std::uint16_t cb_r = 11058, cb_g = 21710, cr_g = 27439, cr_b = 5329;
static_assert(cb_r + cb_g == 1 << 15 && cr_g + cr_b == 1 << 15);
constexpr std::uint16_t chroma_rounding = 128 - 1;

// cos(k pi / 16) / sqrt(2) for odd k and k = 2, 6.
constexpr std::int16_t c1 = in_q15(0.6935199226610737), c3 = in_q15(0.5879378012096793),
                       c5 = in_q15(0.3928474791935511), c7 = in_q15(0.1379496896414715),
                       c2 = in_q15(0.6532814824381883), c6 = in_q15(0.2705980500730985);
// cos(k pi / 16) * sqrt(2) for k = 2, 6, the former without its 1.
constexpr std::int16_t twice_c2_less_1 = in_q15(0.3065629648763766),
                       twice_c6 = in_q15(0.5411961001461970);

constexpr int luma_of(Rgb p) {
    const unsigned sum =
        (p.r * 256u * luma_r >> 16) + (p.g * 256u * luma_g >> 16) + (p.b * 256u * luma_b >> 16);
    return (int((sum + luma_rounding) >> 8) - 128) * 4;
}

struct ChromaSample {
    int cb, cr;
};

constexpr ChromaSample chroma_of(std::initializer_list<Rgb> pixels) {
    ChromaSample sum{};
    for (const Rgb p : pixels) {
        const int r = p.r * 256, g = p.g * 256, b = p.b * 256;
        sum.cb += (b / 2 + chroma_rounding - (r * cb_r >> 16) - (g * cb_g >> 16)) >> 8;
        sum.cr += (r / 2 + chroma_rounding - (g * cr_g >> 16) - (b * cr_b >> 16)) >> 8;
    }
    const int scale = 4 / int(pixels.size());
    return {sum.cb * scale, sum.cr * scale};
}

// Eight values, `stride` apart, become their cosine transform.
constexpr void transform(int* values, int stride, bool first_pass) {
    const auto checked = [](int value) {
        assert(value >= -32768 && value <= 32767);
        return value;
    };
    const auto put = [&](int k, int value) { values[k * stride] = checked(value); };
    int even[4] = {}, odd[4] = {};
    for (int i = 0; i < 4; ++i) {
        const int front = values[i * stride], back = values[(7 - i) * stride];
        even[i] = checked(front + back);
        odd[i] = checked((front - back) * (first_pass ? 16 : 2));
    }
    const int outer = checked(even[0] + even[3]), inner = checked(even[1] + even[2]);
    int a = checked(even[0] - even[3]), b = checked(even[1] - even[2]);
    put(0, outer + inner);
    put(4, outer - inner);
    if (first_pass) {
        a = checked(a * 8);
        b = checked(b * 8);
        put(2, mul15(checked(mul15(a, c2) + mul15(b, c6)), halved(2)));
        put(6, mul15(checked(mul15(a, c6) - mul15(b, c2)), halved(2)));
    } else {
        put(2, a + mul15(a, twice_c2_less_1) + mul15(b, twice_c6));
        put(6, mul15(a, twice_c6) - (b + mul15(b, twice_c2_less_1)));
    }
    constexpr int cosines[4][4] = {
        {c1, c3, c5, c7}, {c3, c7, c1, c5}, {c5, c1, c7, c3}, {c7, c5, c3, c1}};
    constexpr int signs[4][4] = {{1, 1, 1, 1}, {1, -1, -1, -1}, {1, -1, 1, 1}, {1, -1, 1, -1}};
    for (int k = 0; k < 4; ++k) {
        int sum = 0;
        for (int i = 0; i < 4; ++i)
            sum += signs[k][i] * mul15(odd[i], cosines[k][i]);
        put(2 * k + 1, first_pass ? mul15(checked(sum), halved(3)) : sum);
    }
}

// The samples of a block, row by row, become its coefficients.
constexpr void transform_block(int* block) {
    for (int i = 0; i < 8; ++i)
        transform(block + i, 8, true);
    for (int i = 0; i < 8; ++i)
        transform(block + 8 * i, 1, false);
}

// How a coefficient is divided by its step: times `factor`, then times `scale`,
// with at least four binary digits of the fraction in between.
struct Divisor {
    std::int16_t factor = 0, scale = 0;
};

constexpr Divisor divisor_of(int step) {
    int digits = 0;
    while (step >> (digits + 1) != 0)
        ++digits;
    const int factor = ((1 << (15 + digits)) / step + 1) / 2;
    return {std::int16_t(factor), halved(4 + digits)};
}
static_assert(divisor_of(1).factor == 1 << 14 && divisor_of(255).factor == 8224);

// Rounded to the nearest, halves away from 0.
constexpr int divided(int coefficient, Divisor by) {
    const int fine = mul15(coefficient, by.factor);
    return mul15(fine < 0 ? fine - 1 : fine, by.scale);
}

}  // namespace theatron::video::jpeg
