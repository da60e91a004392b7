// SPDX-License-Identifier: Apache-2.0
// Coefficients to samples, once per instruction set: included by
// jpeg_scan.cpp alone.
#if defined(THEATRON_JPEG_SAMPLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_JPEG_SAMPLES_INL
#undef THEATRON_JPEG_SAMPLES_INL
#else
#define THEATRON_JPEG_SAMPLES_INL
#endif

#include "hwy/highway.h"
#include "video/jpeg_pixels.h"
#include "video/jpeg_scan.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg_scan::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Samples = hn::CappedTag<std::int16_t, quad_row>;
using SampleVector = hn::Vec<Samples>;

// x * (1 + minus_1), in 16 bits.
HWY_INLINE SampleVector more_than(SampleVector x, std::int16_t minus_1) {
    return hn::Add(x, hn::MulFixedPoint15(x, hn::Set(Samples(), minus_1)));
}

// One pass of the inverse DCT over eight rows; see jpeg_reference_native.cpp.
HWY_INLINE void transform(SampleVector (&x)[8]) {
    using namespace jpeg_pixels;
    const Samples d;
    const auto a = hn::Add(x[0], x[4]), b = hn::Sub(x[0], x[4]);
    const auto c = hn::Add(x[2], x[6]), c2 = hn::Sub(x[2], x[6]);
    const auto e = hn::Sub(more_than(c2, sqrt2_minus_1), c);
    const SampleVector even[4] = {hn::Add(a, c), hn::Add(b, e), hn::Sub(b, e), hn::Sub(a, c)};

    const auto p = hn::Add(x[1], x[7]), q = hn::Add(x[5], x[3]);
    const auto r = hn::Sub(x[1], x[7]), s = hn::Sub(x[5], x[3]);
    const auto sine = hn::Set(d, rotation_sine);
    const auto turned_r =
        hn::Sub(more_than(r, rotation_cosine_minus_1), hn::MulFixedPoint15(s, sine));
    const auto turned_s =
        hn::Add(more_than(s, rotation_cosine_minus_1), hn::MulFixedPoint15(r, sine));
    SampleVector odd[4];
    odd[0] = hn::Add(p, q);
    odd[1] = hn::Sub(turned_r, odd[0]);
    odd[2] = hn::Sub(more_than(hn::Sub(p, q), sqrt2_minus_1), odd[1]);
    odd[3] = hn::Sub(turned_s, odd[2]);

    for (int i = 0; i < 4; ++i) {
        x[i] = hn::Add(even[i], odd[i]);
        x[7 - i] = hn::Sub(even[i], odd[i]);
    }
}

// Swaps rows and columns in every block. Each round turns the six bits of a value's
// row and column by one; three swap them.
HWY_INLINE void transpose(SampleVector (&x)[8]) {
    const Samples d;
    for (int round = 0; round < 3; ++round) {
        SampleVector y[8];
        for (int i = 0; i < 4; ++i) {
            y[2 * i] = hn::InterleaveLower(d, x[i], x[i + 4]);
            y[2 * i + 1] = hn::InterleaveUpper(d, x[i], x[i + 4]);
        }
        for (int i = 0; i < 8; ++i)
            x[i] = y[i];
    }
}

// Takes a quad, leaving zeros, and writes its samples, eight rows of all four blocks.
HWY_INLINE void transform_quad(std::int16_t* quad, const Component& component, std::uint8_t* out) {
    const Samples d;
    const hn::Rebind<std::uint8_t, Samples> d8;
    for (std::size_t first = 0; first < quad_row; first += hn::Lanes(d)) {
        SampleVector x[8];
        for (int i = 0; i < 8; ++i) {
            std::int16_t* row = quad + i * quad_row + first;
            const auto power = hn::LoadDup128(d, &component.powers[8 * std::size_t(i)]);
            const auto rest = hn::LoadDup128(d, &component.rests[8 * std::size_t(i)]);
            x[i] = hn::MulFixedPoint15(hn::Mul(hn::Load(d, row), power), rest);
            hn::Store(hn::Zero(d), d, row);
        }
        transform(x);
        transpose(x);
        transform(x);
        for (int i = 0; i < 8; ++i)
            hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<jpeg_pixels::sample_bits>(x[i])), d8,
                       out + i * component.strip.stride + first);
    }
}

}  // namespace theatron::video::jpeg_scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
