// SPDX-License-Identifier: Apache-2.0
// From pixels to coefficients, as jpeg_encoder_rule.h defines them. Included once
// per instruction set.
#if defined(THEATRON_VIDEO_JPEG_ENCODER_TRANSFORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_VIDEO_JPEG_ENCODER_TRANSFORM_INL_H
#undef THEATRON_VIDEO_JPEG_ENCODER_TRANSFORM_INL_H
#else
#define THEATRON_VIDEO_JPEG_ENCODER_TRANSFORM_INL_H
#endif

#include "hwy/highway.h"
#include "video/jpeg_encoder_rule.h"
#include "video/jpeg_encoder_tile.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// One lane: the definition itself.

inline int widened_block(int block) {
    return block;
}

inline Rgb pixel_at(const std::uint8_t* row, int x) {
    return {row[3 * x], row[3 * x + 1], row[3 * x + 2]};
}

inline void convert_halved(const std::uint8_t* above, const std::uint8_t* below,
                           std::int16_t* luma_above, std::int16_t* luma_below, std::int16_t* cb,
                           std::int16_t* cr) {
    for (int x = 0; x < tile_width; ++x) {
        luma_above[x] = std::int16_t(luma_of(pixel_at(above, x)));
        luma_below[x] = std::int16_t(luma_of(pixel_at(below, x)));
    }
    for (int x = 0; x < tile_width; x += 2) {
        const ChromaSample chroma = chroma_of({pixel_at(above, x), pixel_at(above, x + 1),
                                               pixel_at(below, x), pixel_at(below, x + 1)});
        cb[x / 2] = std::int16_t(chroma.cb);
        cr[x / 2] = std::int16_t(chroma.cr);
    }
}

inline void convert(const std::uint8_t* row, std::int16_t* y, std::int16_t* cb, std::int16_t* cr) {
    for (int x = 0; x < tile_width; ++x) {
        const Rgb pixel = pixel_at(row, x);
        y[x] = std::int16_t(luma_of(pixel));
        const ChromaSample chroma = chroma_of({pixel});
        cb[x] = std::int16_t(chroma.cb);
        cr[x] = std::int16_t(chroma.cr);
    }
}

template <bool is_luma>
void transform_row(BlockRow& row, int width, const std::int16_t* factor,
                   const std::int16_t* scale) {
    for (int x = 0; x < width; x += 8) {
        int block[64];
        for (int i = 0; i < 64; ++i)
            block[i] = row.values[i / 8][x + i % 8];
        transform_block(block);
        for (int column = 0; column < 8; ++column) {
            unsigned nonzero = 0;
            for (int y = 0; y < 8; ++y) {
                const int at = 8 * column + y;
                const int value = divided(block[8 * y + column], {factor[at], scale[at]});
                row.values[column][x + y] = std::int16_t(value);
                nonzero |= unsigned(value != 0) << y;
            }
            row.nonzero[column][x / 8] = std::uint8_t(nonzero);
        }
    }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Pixels = hn::CappedTag<std::uint8_t, tile_width>;
using Words = hn::Repartition<std::uint16_t, Pixels>;
using Samples = hn::Repartition<std::int16_t, Pixels>;

// From pixels to samples. Luma is left as it is, from 0 to 255: that it is to be
// centred and multiplied by 4 is cheaper to do in the transform.
//
// Even and odd pixels are treated apart, as the bytes of words. Interleaving them
// again is done per 128 bits. Blocks are as wide, so only their order changes:
// first the even ones of a vector of bytes, then the odd ones.

HWY_INLINE int widened_block(int block) {
    const int count = int(hn::Lanes(Pixels())) / 8;
    const int in_vector = block % count;
    return block - in_vector + in_vector / 2 + in_vector % 2 * (count / 2);
}

// Channels of every second pixel, times 256.
struct Channels {
    hn::Vec<Words> r, g, b;
};

HWY_INLINE void load_pixels(const std::uint8_t* from, Channels& even, Channels& odd) {
    const Words d;
    hn::Vec<Pixels> r, g, b;
    hn::LoadInterleaved3(Pixels(), from, r, g, b);
    const auto first = [&](hn::Vec<Pixels> v)
                           HWY_ATTR { return hn::ShiftLeft<8>(hn::BitCast(d, v)); };
    const auto second = [&](hn::Vec<Pixels> v)
                            HWY_ATTR { return hn::And(hn::BitCast(d, v), hn::Set(d, 0xff00)); };
    even = {first(r), first(g), first(b)};
    odd = {second(r), second(g), second(b)};
}

HWY_INLINE hn::Vec<Samples> luma(const Channels& from) {
    const Words d;
    const auto sum = hn::Add(
        hn::Add(hn::MulHigh(from.r, hn::Set(d, luma_r)), hn::MulHigh(from.g, hn::Set(d, luma_g))),
        hn::Add(hn::MulHigh(from.b, hn::Set(d, luma_b)), hn::Set(d, luma_rounding)));
    return hn::BitCast(Samples(), hn::ShiftRight<8>(sum));
}

template <class V>
HWY_INLINE hn::Vec<Samples> chroma(V whole, V less, std::uint16_t less_factor, V lesser,
                                   std::uint16_t lesser_factor) {
    const Words d;
    const auto sum = hn::Sub(hn::Sub(hn::Add(hn::ShiftRight<1>(whole), hn::Set(d, chroma_rounding)),
                                     hn::MulHigh(less, hn::Set(d, less_factor))),
                             hn::MulHigh(lesser, hn::Set(d, lesser_factor)));
    return hn::ShiftRight<8>(hn::BitCast(Samples(), sum));
}

HWY_INLINE hn::Vec<Samples> cb_of(const Channels& from) {
    return chroma(from.b, from.r, cb_r, from.g, cb_g);
}
HWY_INLINE hn::Vec<Samples> cr_of(const Channels& from) {
    return chroma(from.r, from.g, cr_g, from.b, cr_b);
}

HWY_INLINE void put_interleaved(hn::Vec<Samples> even, hn::Vec<Samples> odd, std::int16_t* to) {
    const Samples d;
    hn::Store(hn::InterleaveLower(d, even, odd), d, to);
    hn::Store(hn::InterleaveUpper(d, even, odd), d, to + hn::Lanes(d));
}

// Two rows of a tile, with chroma of half their size.
HWY_INLINE void convert_halved(const std::uint8_t* above, const std::uint8_t* below,
                               std::int16_t* luma_above, std::int16_t* luma_below, std::int16_t* cb,
                               std::int16_t* cr) {
    for (std::size_t x = 0; x < tile_width; x += hn::Lanes(Pixels())) {
        Channels p, q;
        load_pixels(above + 3 * x, p, q);
        put_interleaved(luma(p), luma(q), luma_above + x);
        const auto cb_above = hn::Add(cb_of(p), cb_of(q)), cr_above = hn::Add(cr_of(p), cr_of(q));
        load_pixels(below + 3 * x, p, q);
        put_interleaved(luma(p), luma(q), luma_below + x);
        const auto cb_below = hn::Add(cb_of(p), cb_of(q)), cr_below = hn::Add(cr_of(p), cr_of(q));
        hn::Store(hn::Add(cb_above, cb_below), Samples(), cb + x / 2);
        hn::Store(hn::Add(cr_above, cr_below), Samples(), cr + x / 2);
    }
}

// A row of a tile, with chroma of its own size.
HWY_INLINE void convert(const std::uint8_t* row, std::int16_t* y, std::int16_t* cb,
                        std::int16_t* cr) {
    for (std::size_t x = 0; x < tile_width; x += hn::Lanes(Pixels())) {
        Channels p, q;
        load_pixels(row + 3 * x, p, q);
        put_interleaved(luma(p), luma(q), y + x);
        put_interleaved(hn::ShiftLeft<2>(cb_of(p)), hn::ShiftLeft<2>(cb_of(q)), cb + x);
        put_interleaved(hn::ShiftLeft<2>(cr_of(p)), hn::ShiftLeft<2>(cr_of(q)), cr + x);
    }
}

// From samples to coefficients.

// `raised` binary digits, of luma, are still missing in the samples.
template <bool first_pass, int raised, class V>
HWY_INLINE void transform(V& x0, V& x1, V& x2, V& x3, V& x4, V& x5, V& x6, V& x7) {
    const Samples d;
    const auto times = [&](V v, std::int16_t factor)
                           HWY_ATTR { return hn::MulFixedPoint15(v, hn::Set(d, factor)); };
    constexpr int odd_shift = (first_pass ? 4 : 1) + raised;
    const V o0 = hn::ShiftLeft<odd_shift>(hn::Sub(x0, x7));
    const V o1 = hn::ShiftLeft<odd_shift>(hn::Sub(x1, x6));
    const V o2 = hn::ShiftLeft<odd_shift>(hn::Sub(x2, x5));
    const V o3 = hn::ShiftLeft<odd_shift>(hn::Sub(x3, x4));
    const V e0 = hn::Add(x0, x7), e1 = hn::Add(x1, x6);
    const V e2 = hn::Add(x2, x5), e3 = hn::Add(x3, x4);
    const V outer = hn::Add(e0, e3), inner = hn::Add(e1, e2);
    V a = hn::Sub(e0, e3), b = hn::Sub(e1, e2);
    x0 = hn::ShiftLeft<raised>(hn::Add(outer, inner));
    x4 = hn::ShiftLeft<raised>(hn::Sub(outer, inner));
    if constexpr (first_pass) {
        a = hn::ShiftLeft<3 + raised>(a);
        b = hn::ShiftLeft<3 + raised>(b);
        x2 = times(hn::Add(times(a, c2), times(b, c6)), halved(2));
        x6 = times(hn::Sub(times(a, c6), times(b, c2)), halved(2));
    } else {
        x2 = hn::Add(hn::Add(a, times(a, twice_c2_less_1)), times(b, twice_c6));
        x6 = hn::Sub(times(a, twice_c6), hn::Add(b, times(b, twice_c2_less_1)));
    }
    x1 = hn::Add(hn::Add(times(o0, c1), times(o1, c3)), hn::Add(times(o2, c5), times(o3, c7)));
    x3 = hn::Sub(hn::Sub(times(o0, c3), times(o1, c7)), hn::Add(times(o2, c1), times(o3, c5)));
    x5 = hn::Add(hn::Sub(times(o0, c5), times(o1, c1)), hn::Add(times(o2, c7), times(o3, c3)));
    x7 = hn::Add(hn::Sub(times(o0, c7), times(o1, c5)), hn::Sub(times(o2, c3), times(o3, c1)));
    if constexpr (first_pass) {
        x1 = times(x1, halved(3));
        x3 = times(x3, halved(3));
        x5 = times(x5, halved(3));
        x7 = times(x7, halved(3));
    }
}

// a and b become their lower and upper halves' lanes in turn, per 128 bits.
template <class Lane, class V>
HWY_INLINE void interleave(V& a, V& b) {
    const hn::Repartition<Lane, Samples> d;
    const auto x = hn::BitCast(d, a), y = hn::BitCast(d, b);
    a = hn::BitCast(Samples(), hn::InterleaveLower(d, x, y));
    b = hn::BitCast(Samples(), hn::InterleaveUpper(d, x, y));
}

// Rows of blocks become their columns.
template <class V>
HWY_INLINE void transpose(V& x0, V& x1, V& x2, V& x3, V& x4, V& x5, V& x6, V& x7) {
    interleave<std::uint16_t>(x0, x1);
    interleave<std::uint16_t>(x2, x3);
    interleave<std::uint16_t>(x4, x5);
    interleave<std::uint16_t>(x6, x7);
    // x0: columns 0 to 3 of rows 0 and 1, x1: columns 4 to 7, and so on.
    interleave<std::uint32_t>(x0, x2);
    interleave<std::uint32_t>(x4, x6);
    interleave<std::uint32_t>(x1, x3);
    interleave<std::uint32_t>(x5, x7);
    // x0: columns 0 and 1 of rows 0 to 3, x2: columns 2 and 3, x1: 4 and 5, x3: 6 and 7.
    interleave<std::uint64_t>(x0, x4);
    interleave<std::uint64_t>(x2, x6);
    interleave<std::uint64_t>(x1, x5);
    interleave<std::uint64_t>(x3, x7);
    // Now x0, x4, x2, x6, x1, x5, x3, x7.
    const V column1 = x4, column3 = x6, column4 = x1, column6 = x3;
    x1 = column1;
    x3 = column3;
    x4 = column4;
    x6 = column6;
}

template <bool is_luma>
HWY_INLINE void transform_row(BlockRow& row, int width, const std::int16_t* factor,
                              const std::int16_t* scale) {
    const Samples d;
    for (std::size_t x = 0; x < std::size_t(width); x += hn::Lanes(d)) {
        const auto load = [&](int i) HWY_ATTR { return hn::Load(d, row.values[i] + x); };
        auto x0 = load(0), x1 = load(1), x2 = load(2), x3 = load(3);
        auto x4 = load(4), x5 = load(5), x6 = load(6), x7 = load(7);
        transform<true, is_luma ? 2 : 0>(x0, x1, x2, x3, x4, x5, x6, x7);
        if constexpr (is_luma)
            x0 = hn::Sub(x0, hn::Set(d, 8 * 4 * 128));
        transpose(x0, x1, x2, x3, x4, x5, x6, x7);
        transform<false, 0>(x0, x1, x2, x3, x4, x5, x6, x7);
        const auto put = [&](int column, hn::Vec<Samples> v) HWY_ATTR {
            v = hn::MulFixedPoint15(v, hn::LoadDup128(d, factor + 8 * column));
            // Halves are rounded away from 0.
            v = hn::Add(v, hn::BroadcastSignBit(v));
            v = hn::MulFixedPoint15(v, hn::LoadDup128(d, scale + 8 * column));
            hn::Store(v, d, row.values[column] + x);
            hn::StoreMaskBits(d, hn::Ne(v, hn::Zero(d)), row.nonzero[column] + x / 8);
        };
        put(0, x0);
        put(1, x1);
        put(2, x2);
        put(3, x3);
        put(4, x4);
        put(5, x5);
        put(6, x6);
        put(7, x7);
    }
}

#endif  // HWY_TARGET

}  // namespace theatron::video::jpeg::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
