// SPDX-License-Identifier: Apache-2.0
// Samples to pixels, once per instruction set: included by jpeg_scan.cpp
// alone.
//
// Even and odd pixels go separate ways, in lanes of 16 bits, and meet as bytes.
#if defined(THEATRON_JPEG_COLORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_JPEG_COLORS_INL
#undef THEATRON_JPEG_COLORS_INL
#else
#define THEATRON_JPEG_COLORS_INL
#endif

#include "hwy/highway.h"
#include "video/jpeg_pixels.h"
#include "video/jpeg_scan.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg_scan::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Pixels = hn::CappedTag<std::uint8_t, alignment>;
using PairsOfPixels = hn::RepartitionToWide<Pixels>;
using Colors = hn::RebindToSigned<PairsOfPixels>;
using PairVector = hn::Vec<PairsOfPixels>;
using ColorVector = hn::Vec<Colors>;

// Values of the even pixels and of the odd ones.
struct EvenOdd {
    ColorVector even, odd;
};

// Bytes of pixels, even and odd apart, shifted to jpeg_pixels::color_bits.
HWY_INLINE EvenOdd split(const std::uint8_t* from) {
    const PairsOfPixels d;
    const Colors signed_d;
    const auto pairs = hn::BitCast(d, hn::LoadU(Pixels(), from));
    constexpr int shift = jpeg_pixels::color_bits;
    const auto mask = hn::Set(d, 0xff << shift);
    return {hn::BitCast(signed_d, hn::And(hn::ShiftLeft<shift>(pairs), mask)),
            hn::BitCast(signed_d, hn::And(hn::ShiftRight<8 - shift>(pairs), mask))};
}

// The sums of two rows, three quarters and one, by column; a column more at either
// end is like the last one. Around 0, the weights together 4 and scaled so that those
// of two columns have jpeg_pixels::color_bits.
HWY_INLINE void sum_columns(const std::uint8_t* near, const std::uint8_t* far, int width,
                            std::int16_t* out) {
    const Colors d;
    const hn::Rebind<std::uint8_t, Colors> d8;
    const auto middle = hn::Set(d, 4 * 128);
    for (int x = 0; x < width; x += int(hn::Lanes(d))) {
        const auto a = hn::PromoteTo(d, hn::LoadU(d8, near + x));
        const auto b = hn::PromoteTo(d, hn::LoadU(d8, far + x));
        const auto sum = hn::Add(hn::Add(a, hn::Add(a, a)), hn::Sub(b, middle));
        hn::StoreU(hn::ShiftLeft<jpeg_pixels::color_bits - 4>(sum), d, out + x);
    }
    out[-1] = out[0];
    out[width] = out[width - 1];
}

// Chroma of the pixels from x on, where a row has a sample for each two of them.
class HalvedChroma {
public:
    explicit HalvedChroma(const std::array<std::int16_t*, 2>& sums) : sums_(sums) {}
    HWY_INLINE EvenOdd get(std::size_t component, int x) const {
        const Colors d;
        const std::int16_t* sum = sums_[component] + x / 2;
        const auto here = hn::LoadU(d, sum);
        const auto thrice = hn::Add(here, hn::Add(here, here));
        return {hn::Add(thrice, hn::LoadU(d, sum - 1)), hn::Add(thrice, hn::LoadU(d, sum + 1))};
    }

private:
    std::array<std::int16_t*, 2> sums_;
};

// And where it has one for each.
class FullChroma {
public:
    explicit FullChroma(const std::array<const std::uint8_t*, 2>& rows) : rows_(rows) {}
    HWY_INLINE EvenOdd get(std::size_t component, int x) const {
        const Colors d;
        const auto middle = hn::Set(d, 128 << jpeg_pixels::color_bits);
        const EvenOdd from = split(rows_[component] + x);
        return {hn::Sub(from.even, middle), hn::Sub(from.odd, middle)};
    }

private:
    std::array<const std::uint8_t*, 2> rows_;
};

// Even and odd values, cut to 0..255, as bytes.
HWY_INLINE hn::Vec<Pixels> joined(ColorVector even, ColorVector odd) {
    constexpr int shift = jpeg_pixels::color_bits;
    const Colors d;
    const PairsOfPixels u;
    const auto zero = hn::Zero(d);
    const PairVector low = hn::ShiftRight<shift>(hn::BitCast(u, hn::Max(even, zero)));
    const PairVector high = hn::ShiftLeft<8 - shift>(hn::BitCast(u, hn::Max(odd, zero)));
    return hn::BitCast(Pixels(), hn::Or(low, hn::And(high, hn::Set(u, 0xff00))));
}

// luma + chroma * (1 + minus_1 / 32768); `luma` already has half a step for rounding.
HWY_INLINE ColorVector with(ColorVector luma, ColorVector chroma, std::int16_t minus_1) {
    const auto more = hn::MulFixedPoint15(chroma, hn::Set(Colors(), minus_1));
    return hn::SaturatedAdd(luma, hn::Add(chroma, more));
}

HWY_INLINE ColorVector green(ColorVector luma, ColorVector cb, ColorVector cr) {
    using namespace jpeg_pixels;
    const Colors d;
    return hn::SaturatedSub(luma, hn::Add(hn::MulFixedPoint15(cb, hn::Set(d, green_blue)),
                                          hn::MulFixedPoint15(cr, hn::Set(d, green_red))));
}

template <class Chroma>
HWY_INLINE void put_pixels(const std::uint8_t* luma, const Chroma& chroma, int width, Rgb* out) {
    using namespace jpeg_pixels;
    const Pixels d;
    const int lanes = int(hn::Lanes(d));
    const auto half = hn::Set(Colors(), 1 << (color_bits - 1));
    auto* to = reinterpret_cast<std::uint8_t*>(out);
    for (int x = 0; x < width; x += lanes) {
        EvenOdd y = split(luma + x);
        y = {hn::Or(y.even, half), hn::Or(y.odd, half)};
        const EvenOdd cb = chroma.get(0, x), cr = chroma.get(1, x);
        const auto red =
            joined(with(y.even, cr.even, red_minus_1), with(y.odd, cr.odd, red_minus_1));
        const auto green_ = joined(green(y.even, cb.even, cr.even), green(y.odd, cb.odd, cr.odd));
        const auto blue =
            joined(with(y.even, cb.even, blue_minus_1), with(y.odd, cb.odd, blue_minus_1));
        if (x + lanes <= width) {
            hn::StoreInterleaved3(red, green_, blue, d, to + 3 * x);
        } else {
            HWY_ALIGN std::uint8_t last[3 * alignment];
            hn::StoreInterleaved3(red, green_, blue, d, last);
            std::memcpy(to + 3 * x, last, std::size_t(3 * (width - x)));
        }
    }
}

}  // namespace theatron::video::jpeg_scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
