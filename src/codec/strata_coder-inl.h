// SPDX-License-Identifier: Apache-2.0
// Strata's entropy coder: 32 range coders (rANS), one per lane, which share one
// sequence of 16-bit words. Included once per instruction set.
//
// The encoder runs from the last step to the first and appends words. The
// decoder runs forwards and takes words from the end. A step has up to two
// rounds, tokens and further bits; in a round the words are in lane order.

// No include guard: the namespace differs from one inclusion to the next.
#include <atomic>
#include <bit>
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

HWY_INLINE V32 gather(const std::uint32_t* from, hn::Vec<S32> index) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    // The destination is a zeroed register: the instruction would otherwise wait
    // for the register's previous value.
    return V32{_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, index.raw, from, 4)};
#else
    return hn::GatherIndex(D32(), from, index);
#endif
}

#if !(HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86) && HWY_TARGET != HWY_SCALAR
// Byte shuffles of a vector of 8 words, for each set of lanes. `front` moves the
// words of the lanes in the set to the front; `spread` is its inverse.
struct WordShuffles {
    alignas(16) std::uint8_t front[256][16] = {}, spread[256][16] = {};
    constexpr WordShuffles() {
        for (unsigned set = 0; set < 256; ++set) {
            unsigned count = 0;
            for (unsigned lane = 0; lane < 8; ++lane) {
                if ((set >> lane & 1) == 0)
                    continue;
                for (unsigned half = 0; half < 2; ++half) {
                    front[set][2 * count + half] = std::uint8_t(2 * lane + half);
                    spread[set][2 * lane + half] = std::uint8_t(2 * count + half);
                }
                ++count;
            }
        }
    }
};
inline constexpr WordShuffles word_shuffles;
static_assert(chunk_lanes <= 8);

HWY_INLINE unsigned set_of(M32 mask) {
#if HWY_TARGET == HWY_WASM
    return unsigned(wasm_i32x4_bitmask(mask.raw));
#else
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D32(), mask, bits);
    return bits[0];
#endif
}
HWY_INLINE hn::Vec<Half16> shuffle(hn::Vec<Half16> words, const std::uint8_t* bytes) {
    const hn::Repartition<std::uint8_t, Half16> d8;
    return hn::BitCast(Half16(), bytes_at(hn::BitCast(d8, words), hn::LoadU(d8, bytes)));
}
#endif

// Distributes the first words, in order, to the lanes of the mask. Other lanes
// are unspecified.
HWY_INLINE V32 spread_words(const std::uint16_t* words, M32 mask) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return V32{_mm512_maskz_expand_epi32(mask.raw, load32(words).raw)};
#elif HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_WASM
    return hn::PromoteTo(D32(),
                         shuffle(hn::LoadU(Half16(), words), word_shuffles.spread[set_of(mask)]));
#else
    // A scalar loop for four lanes: a shuffle is not faster.
    const D32 d;
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

HWY_INLINE std::size_t count_of(M32 mask) {
#if HWY_TARGET == HWY_WASM
    return hwy::PopCount(set_of(mask));
#else
    return hn::CountTrue(D32(), mask);
#endif
}

// The number of further bits of each token.
HWY_INLINE V32 extra_bits_of(V32 token) {
    const D32 d;
    const V32 of_long = hn::Sub(hn::ShiftRight<1>(token), hn::Set(d, 10));
    const V32 bits = hn::IfThenElseZero(hn::Gt(token, hn::Set(d, first_long_token - 1)), of_long);
    return hn::IfThenElse(hn::Eq(token, hn::Set(d, literal_low_token)), hn::Set(d, 15), bits);
}
static_assert(extra_bits(first_long_token) == first_long_token / 2 - 10);
static_assert(extra_bits(literal_high_token) == literal_high_token / 2 - 10);

// Converts 16-bit lanes to 32-bit lanes, and back, keeping the low 16 bits.
#if HWY_TARGET == HWY_SCALAR
inline constexpr int wide_parts = 1;
HWY_INLINE void widen(V16 v, V32 (&wide)[wide_parts]) {
    wide[0] = hn::PromoteTo(D32(), v);
}
HWY_INLINE V16 narrow(const V32 (&wide)[wide_parts]) {
    return V16(static_cast<std::uint16_t>(hn::GetLane(wide[0])));
}
#else
inline constexpr int wide_parts = 2;
HWY_INLINE void widen(V16 v, V32 (&wide)[wide_parts]) {
    wide[0] = hn::PromoteTo(D32(), hn::LowerHalf(Half16(), v));
    wide[1] = hn::PromoteTo(D32(), hn::UpperHalf(Half16(), v));
}
HWY_INLINE V16 narrow(const V32 (&wide)[wide_parts]) {
    return hn::ConcatEven(D16(), hn::BitCast(D16(), wide[1]), hn::BitCast(D16(), wide[0]));
}
#endif
static_assert(wide_parts * part_count == max_chunks);

// a > b, both below 2^31.
HWY_INLINE M32 above(V32 a, V32 b) {
    return hn::RebindMask(D32(), hn::Gt(hn::BitCast(S32(), a), hn::BitCast(S32(), b)));
}

class TokenReader {
public:
    TokenReader(const SlotTable& slots, const Stream& stream)
        : slots_(slots.data()), words_(stream.words), left_(std::ptrdiff_t(stream.word_count)) {
        for (int i = 0; i < max_chunks; ++i)
            states_[i] = hn::LoadU(D32(), stream.states.data() + i * chunk_lanes);
    }

    // Reads one token per lane, and its code: the zigzagged difference, or the
    // depth itself for a literal. False if the words ran out.
    HWY_INLINE bool read(const Prediction (&predictions)[part_count], V16 (&tokens)[part_count],
                         V16 (&codes)[part_count]) {
        const D32 d;
        const D16 d16;
        hn::Mask<D16> has_extra[part_count], any_extra = hn::FirstN(d16, 0);
        for (int part = 0; part < part_count; ++part) {
            V32 wide[wide_parts];
            widen(hn::ShiftLeft<probability_bits - 6>(predictions[part].context), wide);
            for (int i = 0; i < wide_parts; ++i) {
                V32& state = states_[part * wide_parts + i];
                const V32 slot = hn::And(state, hn::Set(d, probability_sum - 1));
                const V32 at = hn::Add(hn::ShiftLeft<6>(wide[i]), slot);
                const V32 entry = gather(slots_, hn::BitCast(S32(), at));
                const V32 frequency = hn::ShiftRight<20>(entry);
                const V32 offset = hn::And(hn::ShiftRight<8>(entry), hn::Set(d, 0xfff));
                state =
                    hn::Add(hn::Mul(hn::ShiftRight<probability_bits>(state), frequency), offset);
                wide[i] = entry;
            }
            tokens[part] = hn::And(narrow(wide), hn::Set(d16, 0xff));
            codes[part] = hn::Sub(tokens[part], hn::Set(d16, first_token));
            has_extra[part] = hn::Or(less(hn::Set(d16, first_long_token - 1), tokens[part]),
                                     hn::Eq(tokens[part], hn::Set(d16, literal_low_token)));
            any_extra = hn::Or(any_extra, has_extra[part]);
        }
        refill();
        if (HWY_UNLIKELY(!hn::AllFalse(d16, any_extra)))
            read_extra(has_extra, tokens, codes);
        return left_ >= 0;
    }

    // True if the encoder's output was consumed exactly.
    bool at_end() const {
        const D32 d;
        auto wrong = hn::Zero(d);
        for (const V32 state : states_)
            wrong = hn::Or(wrong, hn::Xor(state, hn::Set(d, least_state)));
        return hn::AllTrue(d, hn::Eq(wrong, hn::Zero(d))) && left_ == 0;
    }

private:
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    HWY_INLINE void read_extra(const hn::Mask<D16> (&)[part_count], const V16 (&tokens)[part_count],
                               V16 (&codes)[part_count]) {
        const D32 d;
        const V32 one = hn::Set(d, 1);
        for (int part = 0; part < part_count; ++part) {
            V32 token[wide_parts], code[wide_parts];
            widen(tokens[part], token);
            widen(codes[part], code);
            for (int i = 0; i < wide_parts; ++i) {
                V32& state = states_[part * wide_parts + i];
                const V32 bits = extra_bits_of(token[i]);
                const V32 extra = hn::And(state, hn::Sub(hn::Shl(one, bits), one));
                state = hn::Shr(state, bits);

                const V32 lead = hn::Or(hn::Set(d, 2), hn::And(token[i], one));
                V32 long_code = hn::Or(hn::Shl(lead, bits), extra);
                long_code = hn::IfThenElse(hn::Eq(token[i], hn::Set(d, literal_high_token)),
                                           hn::Or(extra, hn::Set(d, 0x8000)), long_code);
                long_code = hn::IfThenElse(hn::Eq(token[i], hn::Set(d, literal_low_token)), extra,
                                           long_code);
                code[i] = hn::IfThenElse(hn::Ne(bits, hn::Zero(d)), long_code, code[i]);
            }
            codes[part] = narrow(code);
        }
        refill();
    }
#else
    // Lane by lane: a step has one or two lanes with further bits, seldom more.
    HWY_INLINE void read_extra(const hn::Mask<D16> (&has_extra)[part_count],
                               const V16 (&tokens)[part_count], V16 (&codes)[part_count]) {
        alignas(64) std::uint16_t token[lane_count], code[lane_count];
        alignas(64) std::uint32_t state[lane_count];
        std::uint32_t lanes = 0, small = 0;
        for (int part = 0; part < part_count; ++part) {
            lanes |= std::uint32_t(bits_of(has_extra[part])) << (part * part_lanes);
            hn::Store(tokens[part], D16(), token + part * part_lanes);
            hn::Store(codes[part], D16(), code + part * part_lanes);
        }
        for (int i = 0; i < max_chunks; ++i)
            hn::Store(states_[i], D32(), state + i * chunk_lanes);

        for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
            const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(rest);
            const unsigned bits = extra_bits(token[lane]);
            const unsigned extra = state[lane] & ((1u << bits) - 1);
            code[lane] = long_code_of(token[lane], extra);
            state[lane] >>= bits;
            small |= std::uint32_t(state[lane] < least_state) << lane;
        }
        // Only these states can be below least_state: the others were renormalised.
        left_ -= std::ptrdiff_t(hwy::PopCount(small));
        const std::uint16_t* from = words_ + left_;
        for (std::uint32_t rest = small; rest != 0; rest &= rest - 1) {
            const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(rest);
            state[lane] = state[lane] << 16 | *from++;
        }
        for (int part = 0; part < part_count; ++part)
            codes[part] = hn::Load(D16(), code + part * part_lanes);
        for (int i = 0; i < max_chunks; ++i)
            states_[i] = hn::Load(D32(), state + i * chunk_lanes);
    }
#endif

    // Renormalises: each state below least_state takes one word.
    HWY_INLINE void refill() {
        const D32 d;
        M32 small[max_chunks];
        std::size_t counts[max_chunks];
        std::size_t total = 0;
        for (int i = 0; i < max_chunks; ++i) {
            small[i] = above(hn::Set(d, least_state), states_[i]);
            counts[i] = count_of(small[i]);
            total += counts[i];
        }
        left_ -= std::ptrdiff_t(total);
        const std::uint16_t* from = words_ + left_;
        for (int i = 0; i < max_chunks; ++i) {
            const V32 filled = hn::Or(hn::ShiftLeft<16>(states_[i]), spread_words(from, small[i]));
            states_[i] = hn::IfThenElse(small[i], filled, states_[i]);
            from += counts[i];
        }
    }

    const std::uint32_t* slots_;
    const std::uint16_t* words_;
    std::ptrdiff_t left_;
    alignas(vector_alignment) V32 states_[max_chunks];
};

// Renormalises the marked states: appends their low 16 bits to the words.
HWY_INLINE V32 emit(V32 state, M32 mask, std::uint16_t*& out) {
    const D32 d;
    const V32 low = hn::And(state, hn::Set(d, 0xffff));
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86 || HWY_TARGET == HWY_SCALAR
    store16(hn::Compress(low, mask), out);
    out += count_of(mask);
#else
    // Highway's own Compress of four or eight lanes copies its table on each call.
    const unsigned set = set_of(mask);
    const auto words = hn::DemoteTo(Half16(), hn::BitCast(S32(), low));
    hn::StoreU(shuffle(words, word_shuffles.front[set]), Half16(), out);
    out += hwy::PopCount(set);
#endif
    return hn::IfThenElse(mask, hn::ShiftRight<16>(state), state);
}

// Slightly less than 1 / v. A quotient between 1 and 2^20 that is computed with it
// and rounded down is exact or one too small. (The relative error is at most
// 2^-21 * (1 + 1/4 + 1/2): the factor, the approximation and four roundings.)
HWY_INLINE hn::Vec<F32> reciprocal(hn::Vec<F32> v) {
    const F32 d;
#if HWY_ARCH_X86
    const auto rough = hn::ApproximateReciprocal(v);
    return hn::Mul(rough, hn::NegMulAdd(rough, v, hn::Set(d, 2.0f - 0x1p-21f)));
#else
    return hn::Div(hn::Set(d, 1.0f - 0x1p-21f), v);
#endif
}

// Looks up the frequencies of the next steps' tokens one by one, which some processors do in half
// the time of a gathering instruction. A whole vector of them can be loaded without a stall when
// the stores have left the processor's store queue.
class Entries {
public:
    Entries(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies)
        : tokens_(coded.token), of_(frequencies.of.data()) {
        for (int t = layout.steps - 1; t >= layout.steps - lead; --t)
            look_up(t);
    }

    // To be called with each step, from the last on.
    HWY_INLINE void look_ahead(int t) { look_up(t - lead); }
    HWY_INLINE const std::uint32_t* at(int t) const { return entries_[unsigned(t) % kept]; }

private:
    static constexpr int lead = 3;
    static constexpr unsigned kept = 4;

    HWY_INLINE void look_up(int t) {
        if (t < 0)
            return;
        const std::uint16_t* token = tokens_ + std::size_t(t) * lane_count;
        std::uint32_t* const to = entries_[unsigned(t) % kept];
        for (int lane = 0; lane < lane_count; lane += 2) {
            // One store for two. The fence as in look_up() of strata_skew-inl.h.
            const std::uint64_t first = of_[token[lane]], second = of_[token[lane + 1]];
            const std::uint64_t both = std::endian::native == std::endian::little
                                           ? first | second << 32
                                           : first << 32 | second;
            std::memcpy(to + lane, &both, sizeof(both));
            std::atomic_signal_fence(std::memory_order_seq_cst);
        }
    }

    const std::uint16_t* tokens_;
    const std::uint32_t* of_;
    alignas(vector_alignment) std::uint32_t entries_[kept][lane_count];
};

void encode_tokens(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies,
                   Stream& stream) {
    const D32 d;
    // An array of vectors, kept in registers where enough exist: the steps form one
    // dependency chain.
    V32 states[max_chunks];
    for (V32& state : states)
        state = hn::Set(d, least_state);
    std::uint16_t* out = stream.words;
    Entries entries(layout, coded, frequencies);

    for (int t = layout.steps - 1; t >= 0; --t) {
        entries.look_ahead(t);
        const std::uint16_t* tokens = coded.token + std::size_t(t) * lane_count;
        const std::uint16_t* extras = coded.extra + std::size_t(t) * lane_count;
        if (coded.has_extra[t] != 0) {
            for (int i = 0; i < max_chunks; ++i) {
                const int lane = i * chunk_lanes;
                const V32 token = hn::And(load32(tokens + lane), hn::Set(d, token_count - 1));
                const V32 bits = extra_bits_of(token);
                const V32 one = hn::Set(d, 1);
                const V32 bound = hn::Sub(hn::Shl(one, hn::Sub(hn::Set(d, 31), bits)), one);
                const V32 state = emit(states[i], above(states[i], bound), out);
                const V32 extra = hn::And(load32(extras + lane), hn::Sub(hn::Shl(one, bits), one));
                states[i] = hn::Or(hn::Shl(state, bits), extra);
            }
        }
        for (int i = 0; i < max_chunks; ++i) {
            const V32 entry = hn::Load(d, entries.at(t) + i * chunk_lanes);
            const V32 frequency = hn::And(entry, hn::Set(d, 0xffff));
            const V32 start = hn::ShiftRight<16>(entry);
            const V32 bound = hn::Sub(hn::ShiftLeft<20>(frequency), hn::Set(d, 1));
            const V32 state = emit(states[i], above(states[i], bound), out);

            // The quotient is exact or one too small; the remainder tells which. Adding
            // 2^23 puts the integer quotient into the lowest bits of the mantissa.
            const auto sum =
                hn::MulAdd(hn::ConvertTo(F32(), hn::BitCast(S32(), state)),
                           reciprocal(hn::ConvertTo(F32(), hn::BitCast(S32(), frequency))),
                           hn::Set(F32(), 0x1p23f - 0.5f));
            const V32 quotient = hn::Sub(hn::BitCast(d, sum), hn::Set(d, 0x4b000000));
            const V32 rest = hn::Sub(state, hn::Mul(quotient, frequency));
            const V32 next =
                hn::Add(hn::ShiftLeft<probability_bits>(quotient), hn::Add(rest, start));
            const V32 one_more = hn::Sub(hn::Set(d, probability_sum), frequency);
            states[i] = hn::Add(next, hn::IfThenZeroElse(above(frequency, rest), one_more));
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

// The largest error allowed for a pixel of this depth.
HWY_INLINE V16 tolerance_at(const Model& model, V16 depth, const std::uint8_t* region) {
    const D16 d;
    const V16 square = hn::ShiftRight<4>(hn::MulHigh(depth, depth));
    const V16 sum = hn::Add(hn::Set(d, model.tolerance.constant),
                            hn::Mul(square, hn::Set(d, model.tolerance.squared)));
    const V16 inside = hn::PromoteTo(d, hn::LoadU(D8(), region));
    return hn::IfThenZeroElse(hn::Gt(inside, hn::Zero(d)), hn::Min(sum, hn::Set(d, 2047)));
}

// The quantiser's interval: depth units per unit of a coded difference.
HWY_INLINE V16 quantiser_width(const Model& model, V16 prediction, const std::uint8_t* region) {
    const V16 off = tolerance_at(model, prediction, region);
    return hn::Add(hn::Add(off, off), hn::Set(D16(), 1));
}

struct Quantised {
    V16 difference;
    V16 depth;  // as the decoder reconstructs it
    V16 literal, literal_token;
    hn::Mask<D16> is_literal;
};

HWY_INLINE Quantised quantise(const Model& model, V16 prediction, V16 depth,
                              hn::Mask<D16> is_measured, const std::uint8_t* region) {
    const D16 d;
    const V16 width = quantiser_width(model, prediction, region);
    const V16 difference = hn::Sub(depth, prediction);
    const V16 sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), difference)));
    const V16 size = hn::Sub(hn::Xor(difference, sign), sign);

    alignas(64) std::uint16_t dividend[hn::MaxLanes(d)], divisor[hn::MaxLanes(d)];
    hn::Store(hn::Add(size, hn::ShiftRight<1>(width)), d, dividend);
    hn::Store(width, d, divisor);
    // Single precision gives exact 16-bit quotients: two different quotients are
    // further apart than its rounding error.
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
