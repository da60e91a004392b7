// SPDX-License-Identifier: Apache-2.0
// Strata's entropy coder: 32 range coders (rANS), one per lane, which share one
// sequence of 16-bit words. Included once per instruction set.
//
// The encoder goes from the last step to the first and appends words; the
// decoder goes forward and takes words from the end. In both, the words of one
// phase of a step lie in the order of the lanes.

// No include guard: the namespace differs from one inclusion to the next.
#include <cstring>

#include "codec/strata_kernel.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D32 = hn::CappedTag<std::uint32_t, 16>;
using S32 = hn::RebindToSigned<D32>;
using F32 = hn::Rebind<float, D32>;
using Half16 = hn::Rebind<std::uint16_t, D32>;
using V32 = hn::Vec<D32>;
using M32 = hn::Mask<D32>;

inline constexpr std::uint32_t least_state = 1u << 15;  // states stay below 2^31
inline constexpr int chunk_lanes = int(hn::MaxLanes(D32()));
inline constexpr int max_chunks = lane_count / chunk_lanes;

HWY_INLINE V32 load32(const std::uint16_t* from) {
    return hn::PromoteTo(D32(), hn::LoadU(Half16(), from));
}
HWY_INLINE void store16(V32 v, std::uint16_t* to) {
    hn::StoreU(hn::DemoteTo(Half16(), hn::BitCast(S32(), v)), Half16(), to);
}

// The first words, in order, to the lanes of the mask.
HWY_INLINE V32 spread_words(const std::uint16_t* words, M32 mask) {
    const D32 d;
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return V32{_mm512_maskz_expand_epi32(mask.raw, load32(words).raw)};
#else
    alignas(64) std::uint32_t wanted[chunk_lanes];
    hn::Store(hn::IfThenElseZero(mask, hn::Set(d, 1)), d, wanted);
    std::uint32_t taken = 0;
    for (std::uint32_t& lane : wanted) {
        const std::uint32_t word = words[taken];
        taken += lane;
        lane = word;
    }
    return hn::Load(d, wanted);
#endif
}

// How many bits follow each token.
HWY_INLINE V32 extra_bits_of(V32 token) {
    const D32 d;
    const V32 of_long = hn::Sub(hn::ShiftRight<1>(token), hn::Set(d, 10));
    const V32 bits = hn::IfThenElseZero(hn::Gt(token, hn::Set(d, first_long_token - 1)), of_long);
    return hn::IfThenElse(hn::Eq(token, hn::Set(d, literal_low_token)), hn::Set(d, 15), bits);
}
static_assert(extra_bits(first_long_token) == first_long_token / 2 - 10);
static_assert(extra_bits(literal_high_token) == literal_high_token / 2 - 10);

class TokenReader {
public:
    TokenReader(const SlotTable& slots, const Stream& stream)
        : slots_(slots.data()), words_(stream.words), left_(std::ptrdiff_t(stream.word_count)) {
        std::memcpy(states_, stream.states.data(), sizeof(states_));
    }

    // Reads one token of each lane, and the code of its difference: zigzag of
    // the difference, or the depth of a literal. False if the words ran out.
    bool read(const std::uint16_t* contexts, std::uint16_t* tokens, std::uint16_t* codes) {
        const D32 d;
        M32 has_extra = hn::FirstN(d, 0);
        for (int lane = 0; lane < lane_count; lane += chunk_lanes) {
            const V32 state = hn::Load(d, states_ + lane);
            const V32 slot = hn::And(state, hn::Set(d, probability_sum - 1));
            const V32 at = hn::Or(hn::ShiftLeft<probability_bits>(load32(contexts + lane)), slot);
            const V32 entry = hn::GatherIndex(d, slots_, hn::BitCast(S32(), at));
            const V32 token = hn::And(entry, hn::Set(d, 0xff));
            const V32 frequency = hn::ShiftRight<20>(entry);
            const V32 offset = hn::And(hn::ShiftRight<8>(entry), hn::Set(d, 0xfff));
            hn::Store(hn::Add(hn::Mul(hn::ShiftRight<probability_bits>(state), frequency), offset),
                      d, states_ + lane);
            has_extra = hn::Or(has_extra, hn::Or(hn::Gt(token, hn::Set(d, first_long_token - 1)),
                                                 hn::Eq(token, hn::Set(d, literal_low_token))));
            store16(token, tokens + lane);
            store16(hn::And(hn::Sub(token, hn::Set(d, first_token)), hn::Set(d, 0xffff)),
                    codes + lane);
        }
        refill();
        if (HWY_UNLIKELY(!hn::AllFalse(d, has_extra)))
            read_extra(tokens, codes);
        return left_ >= 0;
    }

    // True if all that the encoder wrote has been read, and nothing else.
    bool at_end() const {
        std::uint32_t wrong = 0;
        for (const std::uint32_t state : states_)
            wrong |= state ^ least_state;
        return wrong == 0 && left_ == 0;
    }

private:
    void read_extra(const std::uint16_t* tokens, std::uint16_t* codes) {
        const D32 d;
        const V32 one = hn::Set(d, 1);
        for (int lane = 0; lane < lane_count; lane += chunk_lanes) {
            const V32 state = hn::Load(d, states_ + lane);
            const V32 token = load32(tokens + lane);
            const V32 bits = extra_bits_of(token);
            const V32 extra = hn::And(state, hn::Sub(hn::Shl(one, bits), one));
            hn::Store(hn::Shr(state, bits), d, states_ + lane);

            const V32 lead = hn::Or(hn::Set(d, 2), hn::And(token, one));
            V32 code = hn::Or(hn::Shl(lead, bits), extra);
            code = hn::IfThenElse(hn::Eq(token, hn::Set(d, literal_high_token)),
                                  hn::Or(extra, hn::Set(d, 0x8000)), code);
            code = hn::IfThenElse(hn::Eq(token, hn::Set(d, literal_low_token)), extra, code);
            code = hn::IfThenElse(hn::Ne(bits, hn::Zero(d)), code, load32(codes + lane));
            store16(hn::And(code, hn::Set(d, 0xffff)), codes + lane);
        }
        refill();
    }

    // Gives every state that became small a word.
    void refill() {
        const D32 d;
        M32 small[max_chunks];
        std::size_t counts[max_chunks];
        std::size_t total = 0;
        for (int i = 0; i < max_chunks; ++i) {
            small[i] = hn::Lt(hn::Load(d, states_ + i * chunk_lanes), hn::Set(d, least_state));
            counts[i] = hn::CountTrue(d, small[i]);
            total += counts[i];
        }
        left_ -= std::ptrdiff_t(total);
        const std::uint16_t* from = words_ + left_;
        for (int i = 0; i < max_chunks; ++i) {
            const V32 state = hn::Load(d, states_ + i * chunk_lanes);
            const V32 filled = hn::Or(hn::ShiftLeft<16>(state), spread_words(from, small[i]));
            hn::Store(hn::IfThenElse(small[i], filled, state), d, states_ + i * chunk_lanes);
            from += counts[i];
        }
    }

    const std::uint32_t* slots_;
    const std::uint16_t* words_;
    std::ptrdiff_t left_;
    alignas(64) std::uint32_t states_[lane_count];
};

// Moves the low halves of the marked states to the words.
HWY_INLINE V32 emit(V32 state, M32 mask, std::uint16_t*& out) {
    const D32 d;
    const V32 low = hn::And(state, hn::Set(d, 0xffff));
    store16(hn::Compress(low, mask), out);
    out += hn::CountTrue(d, mask);
    return hn::IfThenElse(mask, hn::ShiftRight<16>(state), state);
}

// 1 / v, so well that quotients below 2^20 are off by less than 1.
HWY_INLINE hn::Vec<F32> reciprocal(hn::Vec<F32> v) {
    const F32 d;
#if HWY_ARCH_X86
    const auto rough = hn::ApproximateReciprocal(v);
    return hn::Mul(rough, hn::NegMulAdd(rough, v, hn::Set(d, 2.0f)));
#else
    return hn::Div(hn::Set(d, 1.0f), v);
#endif
}

void encode_tokens(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies,
                   Stream& stream) {
    const D32 d;
    // In registers, if there are few: each step waits for the one before.
    V32 states[max_chunks];
    for (V32& state : states)
        state = hn::Set(d, least_state);
    std::uint16_t* out = stream.words;

    for (int t = layout.steps - 1; t >= 0; --t) {
        const std::uint16_t* tokens = coded.token + std::size_t(t) * lane_count;
        const std::uint16_t* extras = coded.extra + std::size_t(t) * lane_count;
        M32 has_extra = hn::FirstN(d, 0);
        for (int lane = 0; lane < lane_count; lane += chunk_lanes) {
            const V32 token = hn::And(load32(tokens + lane), hn::Set(d, token_count - 1));
            has_extra = hn::Or(has_extra, hn::Or(hn::Gt(token, hn::Set(d, first_long_token - 1)),
                                                 hn::Eq(token, hn::Set(d, literal_low_token))));
        }
        if (HWY_UNLIKELY(!hn::AllFalse(d, has_extra))) {
            for (int i = 0; i < max_chunks; ++i) {
                const int lane = i * chunk_lanes;
                const V32 token = hn::And(load32(tokens + lane), hn::Set(d, token_count - 1));
                const V32 bits = extra_bits_of(token);
                const V32 bound = hn::Shl(hn::Set(d, 1), hn::Sub(hn::Set(d, 31), bits));
                const V32 state = emit(states[i], hn::Not(hn::Lt(states[i], bound)), out);
                states[i] = hn::Or(hn::Shl(state, bits), load32(extras + lane));
            }
        }
        for (int i = 0; i < max_chunks; ++i) {
            const V32 entry = hn::GatherIndex(d, frequencies.of.data(),
                                              hn::BitCast(S32(), load32(tokens + i * chunk_lanes)));
            const V32 frequency = hn::And(entry, hn::Set(d, 0xffff));
            const V32 start = hn::ShiftRight<16>(entry);
            const V32 bound = hn::ShiftLeft<20>(frequency);
            const V32 state = emit(states[i], hn::Not(hn::Lt(states[i], bound)), out);

            // The quotient in floating point is off by one at most; the
            // remainder shows it.
            const auto ratio =
                hn::Mul(hn::ConvertTo(F32(), hn::BitCast(S32(), state)),
                        reciprocal(hn::ConvertTo(F32(), hn::BitCast(S32(), frequency))));
            V32 quotient = hn::BitCast(d, hn::ConvertTo(S32(), ratio));
            V32 rest = hn::Sub(state, hn::Mul(quotient, frequency));
            const auto too_much = hn::Gt(rest, hn::Set(d, 0x7fffffff));
            quotient = hn::Sub(quotient, hn::IfThenElseZero(too_much, hn::Set(d, 1)));
            rest = hn::Add(rest, hn::IfThenElseZero(too_much, frequency));
            const auto too_little = hn::Not(hn::Lt(rest, frequency));
            quotient = hn::Add(quotient, hn::IfThenElseZero(too_little, hn::Set(d, 1)));
            rest = hn::Sub(rest, hn::IfThenElseZero(too_little, frequency));
            states[i] = hn::Add(hn::ShiftLeft<probability_bits>(quotient), hn::Add(rest, start));
        }
    }
    stream.word_count = std::size_t(out - stream.words);
    for (int i = 0; i < max_chunks; ++i)
        hn::StoreU(states[i], d, stream.states.data() + i * chunk_lanes);
}

HWY_INLINE V16 zigzag(V16 difference) {
    const D16 d;
    const V16 sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), difference)));
    return hn::Xor(hn::Add(difference, difference), sign);
}
HWY_INLINE V16 unzigzag(V16 code) {
    const D16 d;
    const V16 sign = hn::Sub(hn::Zero(d), hn::And(code, hn::Set(d, 1)));
    return hn::Xor(hn::ShiftRight<1>(code), sign);
}

// How far a pixel of this depth may be off.
HWY_INLINE V16 tolerance_at(const Model& model, V16 depth, const std::uint8_t* region) {
    const D16 d;
    const V16 square = hn::ShiftRight<4>(hn::MulHigh(depth, depth));
    const V16 sum = hn::Add(hn::Set(d, model.tolerance.constant),
                            hn::Mul(square, hn::Set(d, model.tolerance.squared)));
    const V16 inside = hn::PromoteTo(d, hn::LoadU(D8(), region));
    return hn::IfThenZeroElse(hn::Gt(inside, hn::Zero(d)), hn::Min(sum, hn::Set(d, 2047)));
}

// What one unit of a coded difference stands for.
HWY_INLINE V16 step_width(const Model& model, V16 prediction, const std::uint8_t* region) {
    const V16 off = tolerance_at(model, prediction, region);
    return hn::Add(hn::Add(off, off), hn::Set(D16(), 1));
}

struct Quantised {
    V16 difference;
    V16 depth;  // what the decoder will have
    V16 literal, literal_token;
    hn::Mask<D16> is_literal;
};

HWY_INLINE Quantised quantise(const Model& model, V16 prediction, V16 depth,
                              hn::Mask<D16> is_measured, const std::uint8_t* region) {
    const D16 d;
    const V16 width = step_width(model, prediction, region);
    const V16 difference = hn::Sub(depth, prediction);
    const V16 sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), difference)));
    const V16 size = hn::Sub(hn::Xor(difference, sign), sign);

    alignas(64) std::uint16_t dividend[hn::MaxLanes(d)], divisor[hn::MaxLanes(d)];
    hn::Store(hn::Add(size, hn::ShiftRight<1>(width)), d, dividend);
    hn::Store(width, d, divisor);
    // 16-bit quotients are exact in floating point: two of them that differ do
    // so by more than its rounding.
    const auto as_float = [](const std::uint16_t* from) HWY_ATTR {
        return hn::ConvertTo(F32(), hn::BitCast(S32(), load32(from)));
    };
    for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(D32())) {
        const auto ratio = hn::Div(as_float(dividend + i), as_float(divisor + i));
        store16(hn::BitCast(D32(), hn::ConvertTo(S32(), ratio)), dividend + i);
    }
    const V16 units = hn::Load(d, dividend);

    Quantised q;
    q.difference = hn::Sub(hn::Xor(units, sign), sign);
    q.depth = hn::Add(prediction, hn::Mul(q.difference, width));
    const V16 off = hn::Sub(hn::Max(depth, q.depth), hn::Min(depth, q.depth));
    const auto is_hole = hn::Or(hn::Eq(q.depth, hn::Zero(d)), hn::Eq(q.depth, hn::Set(d, 0xffff)));
    const auto is_far = hn::Gt(off, tolerance_at(model, depth, region));
    q.is_literal = hn::And(is_measured, hn::Or(is_hole, is_far));
    q.literal = hn::And(depth, hn::Set(d, 0x7fff));
    q.literal_token = hn::IfThenElse(hn::Gt(depth, hn::Set(d, 0x7fff)),
                                     hn::Set(d, literal_high_token), hn::Set(d, literal_low_token));
    q.difference = hn::IfThenElse(q.is_literal, hn::Set(d, 255), q.difference);
    q.difference = hn::IfThenElseZero(is_measured, q.difference);
    q.depth = hn::IfThenElse(hn::AndNot(q.is_literal, is_measured), q.depth, depth);
    return q;
}

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
