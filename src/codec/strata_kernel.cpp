// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_kernel.h"

#include <algorithm>
#include <cstring>
#include <vector>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "codec/strata_kernel.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// The order matters: each file uses the one before.
#include "codec/strata_lanes-inl.h"

#include "codec/strata_model-inl.h"

#include "codec/strata_coder-inl.h"

#include "codec/strata_skew-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {

// Iterates over the steps. Owns the traces, and carries values between groups: lane 0
// needs those of lane 31 of the previous group.
template <bool blend>
class Walk {
public:
    explicit Walk(const Model& model) : model_(model), delay_(model.layout.delay()) {
        while (delayed_steps_ < delay_ + copy_lag)
            delayed_steps_ *= 2;
        delayed_.resize(std::size_t(delayed_steps_) * kept_traces);
        const std::size_t end = std::size_t(model.layout.steps + plane_margin);
        for (const std::size_t margin : {std::size_t(0), end}) {
            std::fill_n(model.depth + margin * plane_stride, plane_margin * plane_stride, 0);
            std::fill_n(model.valid + margin, plane_margin, 0);
        }
    }

    // Fills the values beside the lanes with those of the neighbouring groups.
    Step begin(int index) {
        const auto row = std::size_t(index + plane_margin);
        const std::size_t at = row * plane_stride + plane_origin;
        Step step{model_.depth + at,
                  model_.valid + row,
                  model_.reference_depth,
                  model_.reference_valid,
                  index,
                  position_,
                  group_,
                  is_inside()};
        if (step.reference_depth != nullptr) {
            step.reference_depth += at;
            step.reference_valid += row;
        }
        const std::ptrdiff_t back = std::ptrdiff_t(delay_) * plane_stride;
        constexpr std::size_t front = plane_origin,
                              behind = plane_stride - plane_origin - lane_count;
        std::uint16_t* const depth = step.depth;
        if (index >= delay_) {
            std::memcpy(depth - front, depth + lane_count - front - back, front * sizeof(*depth));
            *step.valid = step.valid[-delay_] >> lane_count & ((1u << front) - 1);
        } else {
            std::memset(depth - front, 0, front * sizeof(*depth));
            *step.valid = 0;
        }
        std::memset(depth + lane_count, 0, behind * sizeof(*depth));
        const std::uint16_t* above = delayed(index - delay_);
        for (int i = 0; i < kept_traces; ++i)
            traces.at(index, i)[-1] = above[i];
        return step;
    }

    // Ends a step. Its values for other groups are copied copy_lag steps later, when
    // the stores have left the processor's store queue and can be read without a stall.
    void end(int index) {
        copy_lanes(index - copy_lag);
        if (++position_ == model_.layout.pitch) {
            position_ = 0;
            ++group_;
        }
    }

    void finish() {
        for (int i = copy_lag - 1; i >= 0; --i)
            copy_lanes(model_.layout.steps - 1 - i);
    }

    Traces traces;

private:
    static constexpr int copy_lag = 4;
    static_assert(copy_lag < least_delay);
    static constexpr int kept_traces = blend ? int(trace_count) : int(triple0);

    bool is_inside() const {
        const Size size = model_.layout.size;
        const int x = position_ - row_front;  // of lane 0
        return x >= skew * (lane_count - 1) && x < size.width &&
               (group_ + 1) * lane_count <= size.height;
    }

    // Traces of lane 31 at an earlier step; 0 for steps before the first.
    std::uint16_t* delayed(int index) {
        return delayed_.data() + std::size_t(index & (delayed_steps_ - 1)) * kept_traces;
    }

    void copy_lanes(int index) {
        if (index < 0)
            return;
        std::uint16_t* to = delayed(index);
        for (int i = 0; i < kept_traces; ++i)
            to[i] = traces.at(index, i)[lane_count - 1];
        if (index < delay_)
            return;
        const auto row = std::size_t(index + plane_margin);
        const std::size_t from = row * plane_stride + plane_origin;
        const std::size_t copy = from + lane_count - std::size_t(delay_) * plane_stride;
        model_.depth[copy] = model_.depth[from];
        model_.valid[row - std::size_t(delay_)] |= (model_.valid[row] >> plane_origin & 1)
                                                   << (plane_origin + lane_count);
    }

    const Model& model_;
    int delay_;
    int position_ = 0, group_ = 0;  // of lane 0
    int delayed_steps_ = 1;
    std::vector<std::uint16_t> delayed_;
};

HWY_INLINE void load_weights(const Weights& from, LinearWeights& weights) {
    for (int i = 0; i < tap_count; ++i)
        weights[i] = hn::Set(S16(), from[i]);
}

// Converts zigzagged differences to tokens. Returns true and stores the further bits
// if any token has some.
HWY_INLINE bool tokens_of(V16 code, V16& token, std::uint16_t* extra) {
    const D16 d;
    token = hn::Add(code, hn::Set(d, first_token));
    const auto is_long = hn::Gt(code, hn::Set(d, direct_tokens - 1));
    if (HWY_LIKELY(hn::AllFalse(d, is_long)))
        return false;
    const D32 d32;
    const V32 one = hn::Set(d32, 1);
    V32 wide[wide_parts], tokens[wide_parts], extras[wide_parts];
    widen(code, wide);
    for (int i = 0; i < wide_parts; ++i) {
        // In floating point, the exponent holds the position of the highest bit, and
        // the top mantissa bit is the next one. Bits 22 and up are both together.
        const V32 as_float = hn::BitCast(d32, hn::ConvertTo(F32(), hn::BitCast(S32(), wide[i])));
        const V32 halves = hn::Sub(hn::ShiftRight<22>(as_float), hn::Set(d32, 2 * 127));
        const V32 bits = hn::Sub(hn::ShiftRight<1>(halves), one);
        tokens[i] = hn::Add(halves, hn::Set(d32, first_long_token - 9));
        extras[i] = hn::And(wide[i], hn::Sub(hn::Shl(one, hn::And(bits, hn::Set(d32, 15))), one));
    }
    token = hn::IfThenElse(is_long, narrow(tokens), token);
    hn::StoreU(hn::IfThenElseZero(is_long, narrow(extras)), d, extra);
    return true;
}

// Counts the tokens of these steps. The tables are used in turn, so that increments of equal
// tokens do not wait for each other.
HWY_NOINLINE void count_steps(const CodedPixels& coded, int from, int to) {
    constexpr std::size_t tables = std::tuple_size_v<decltype(TokenCounts::of)>;
    static_assert(lane_count % tables == 0);
    auto& counts = coded.counts->of;
    const std::uint16_t* const end = coded.token + std::size_t(to) * lane_count;
    for (const std::uint16_t* at = coded.token + std::size_t(from) * lane_count; at < end;
         at += tables)
        for (std::size_t i = 0; i < tables; ++i)
            ++counts[i][at[i]];
}

template <bool temporal, bool blend, bool lossy>
void encode_steps(const Model& model, const std::uint16_t* pixels, const CodedPixels& coded) {
    const D16 d;
    // Steps that are counted at once: counting beside the model keeps the processor from beginning
    // the next step.
    constexpr int counted = 64;
    Walk<blend> walk(model);
    LinearWeights weights;
    load_weights(model.weights, weights);
    Window windows[part_count];
    for (int t = 0; t < model.layout.steps; ++t) {
        const Step step = walk.begin(t);
        bool has_extra = false;
        for (int part = 0; part < part_count; ++part) {
            const int lane = part * part_lanes;
            Window& window = windows[part];
            if (t == 0)
                window = begin_window<temporal>(step, lane);
            const std::size_t at = std::size_t(t) * lane_count + lane;
            Prediction p = predict<temporal, blend>(weights, step, walk.traces, window, lane);
            // Positions outside the image hold 0, like a hole.
            V16 depth = hn::LoadU(d, pixels + at);
            const V16 one = hn::Set(d, 1);
            const auto is_measured = hn::Gt(hn::Add(depth, one), one);

            V16 difference = hn::IfThenElseZero(is_measured, hn::Sub(depth, p.depth));
            V16 token;
            // Depths 0 and 65535 become tokens 0 and 1.
            const V16 hole = hn::And(depth, one);
            std::uint16_t* const extra = coded.extra + at;
            if constexpr (lossy) {
                const Quantised q = quantise(model, p.depth, depth, is_measured, model.region + at);
                difference = q.difference;
                depth = q.depth;
                hn::StoreU(hn::Zero(d), d, extra);
                has_extra |=
                    tokens_of(zigzag(hn::Sub(hn::Xor(difference, p.flip), p.flip)), token, extra);
                has_extra |= !hn::AllFalse(d, q.is_literal);
                token = hn::IfThenElse(q.is_literal, q.literal_token, token);
                hn::StoreU(hn::IfThenElse(q.is_literal, q.literal, hn::LoadU(d, extra)), d, extra);
            } else {
                has_extra |=
                    tokens_of(zigzag(hn::Sub(hn::Xor(difference, p.flip), p.flip)), token, extra);
            }
            token = hn::IfThenElse(is_measured, token, hole);

            Kept kept;
            kept.residual = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), difference)));
            kept.depth = hn::IfThenElse(is_measured, depth, p.depth);
            kept.measured = is_measured;
            if (HWY_UNLIKELY(!step.inside)) {
                const Outside outside = outside_of(model.layout, step.position, step.group,
                                                   step.depth, step.valid, window.left, lane);
                p.context = hn::IfThenElse(outside.is_pixel, p.context, hn::Set(d, idle_context));
                keep_outside(outside, p.candidate, kept);
            }
            hn::StoreU(hn::Add(hn::ShiftLeft<6>(p.context), token), d, coded.token + at);
            keep<blend>(p.candidate, kept, step, walk.traces, window, lane);
        }
        coded.has_extra[t] = has_extra;
        if ((t + 1) % counted == 0)
            count_steps(coded, t + 1 - counted, t + 1);
        walk.end(t);
    }
    count_steps(coded, model.layout.steps / counted * counted, model.layout.steps);
    walk.finish();
}

template <bool temporal, bool blend, bool lossy>
bool decode_steps_as(const Model& model, const SlotTable& slots, const Stream& stream,
                     std::uint16_t* pixels) {
    const D16 d;
    Walk<blend> walk(model);
    LinearWeights weights;
    load_weights(model.weights, weights);
    alignas(vector_alignment) Window windows[part_count];
    TokenReader reader(slots, stream);
    for (int t = 0; t < model.layout.steps; ++t) {
        const Step step = walk.begin(t);
        alignas(vector_alignment) Prediction predictions[part_count];
        alignas(vector_alignment) Outside outsides[part_count];
        alignas(vector_alignment) V16 tokens[part_count], codes[part_count];
        for (int part = 0; part < part_count; ++part) {
            const int lane = part * part_lanes;
            Window& window = windows[part];
            if (t == 0)
                window = begin_window<temporal>(step, lane);
            Prediction& p = predictions[part];
            p = predict<temporal, blend>(weights, step, walk.traces, window, lane);
            if (HWY_UNLIKELY(!step.inside)) {
                outsides[part] = outside_of(model.layout, step.position, step.group, step.depth,
                                            step.valid, window.left, lane);
                p.context =
                    hn::IfThenElse(outsides[part].is_pixel, p.context, hn::Set(d, idle_context));
            }
        }
        if (!reader.read(predictions, tokens, codes))
            return false;
        for (int part = 0; part < part_count; ++part) {
            const int lane = part * part_lanes;
            const std::size_t at = std::size_t(t) * lane_count + lane;
            Prediction& p = predictions[part];
            const V16 token = tokens[part], code = codes[part];
            // Positions outside the image decode to a hole.
            const auto is_measured = less(hn::Set(d, literal_low_token - 1), token);

            V16 difference = hn::Sub(hn::Xor(unzigzag(code), p.flip), p.flip);
            difference = hn::IfThenElseZero(is_measured, difference);
            Kept kept;
            kept.residual = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), difference)));
            V16 depth;
            if constexpr (lossy) {
                const V16 width = quantiser_width(model, p.depth, model.region + at);
                depth = hn::Add(p.depth, hn::Mul(difference, width));
                const auto is_literal =
                    hn::And(is_measured, hn::Or(hn::Eq(token, hn::Set(d, literal_low_token)),
                                                hn::Eq(token, hn::Set(d, literal_high_token))));
                depth = hn::IfThenElse(is_literal, code, depth);
                kept.residual = hn::IfThenElse(is_literal, hn::Set(d, 255), kept.residual);
            } else {
                depth = hn::Add(p.depth, difference);
            }
            // Tokens 0 and 1 become depths 0 and 65535.
            const V16 hole = hn::Sub(hn::Zero(d), token);
            hn::StoreU(hn::IfThenElse(is_measured, depth, hole), d, pixels + at);

            kept.depth = hn::IfThenElse(is_measured, depth, p.depth);
            kept.measured = is_measured;
            if (HWY_UNLIKELY(!step.inside))
                keep_outside(outsides[part], p.candidate, kept);
            keep<blend>(p.candidate, kept, step, walk.traces, windows[part], lane);
        }
        walk.end(t);
    }
    walk.finish();
    return reader.at_end();
}

void encode_model(const Model& model, const std::uint16_t* pixels, const CodedPixels& coded) {
    const bool temporal = model.reference_depth != nullptr;
    const bool lossy = !model.tolerance.lossless();
    if (lossy) {
        if (temporal)
            model.blend ? encode_steps<true, true, true>(model, pixels, coded)
                        : encode_steps<true, false, true>(model, pixels, coded);
        else
            model.blend ? encode_steps<false, true, true>(model, pixels, coded)
                        : encode_steps<false, false, true>(model, pixels, coded);
    } else {
        if (temporal)
            model.blend ? encode_steps<true, true, false>(model, pixels, coded)
                        : encode_steps<true, false, false>(model, pixels, coded);
        else
            model.blend ? encode_steps<false, true, false>(model, pixels, coded)
                        : encode_steps<false, false, false>(model, pixels, coded);
    }
}

bool decode_steps(const Model& model, const SlotTable& slots, const Stream& stream,
                  std::uint16_t* pixels) {
    const bool temporal = model.reference_depth != nullptr;
    if (!model.tolerance.lossless()) {
        if (temporal)
            return model.blend ? decode_steps_as<true, true, true>(model, slots, stream, pixels)
                               : decode_steps_as<true, false, true>(model, slots, stream, pixels);
        return model.blend ? decode_steps_as<false, true, true>(model, slots, stream, pixels)
                           : decode_steps_as<false, false, true>(model, slots, stream, pixels);
    }
    if (temporal)
        return model.blend ? decode_steps_as<true, true, false>(model, slots, stream, pixels)
                           : decode_steps_as<true, false, false>(model, slots, stream, pixels);
    return model.blend ? decode_steps_as<false, true, false>(model, slots, stream, pixels)
                       : decode_steps_as<false, false, false>(model, slots, stream, pixels);
}

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::codec::strata {

HWY_EXPORT(encode_model);
HWY_EXPORT(decode_steps);
HWY_EXPORT(encode_tokens);
HWY_EXPORT(rows_to_steps);
HWY_EXPORT(steps_to_rows);
HWY_EXPORT(rows_to_ranks);
HWY_EXPORT(sample_equations);
HWY_EXPORT(shift_ranks);

void encode_model(const Model& model, const std::uint16_t* pixels, const CodedPixels& coded) {
    HWY_DYNAMIC_DISPATCH(encode_model)(model, pixels, coded);
}
bool decode_steps(const Model& model, const SlotTable& slots, const Stream& stream,
                  std::uint16_t* pixels) {
    return HWY_DYNAMIC_DISPATCH(decode_steps)(model, slots, stream, pixels);
}
void encode_tokens(const Layout& layout, const CodedPixels& coded, const Frequencies& frequencies,
                   Stream& stream) {
    HWY_DYNAMIC_DISPATCH(encode_tokens)(layout, coded, frequencies, stream);
}
void rows_to_steps(const Layout& layout, DepthView depth, std::uint16_t* pixels) {
    HWY_DYNAMIC_DISPATCH(rows_to_steps)(layout, depth, pixels);
}
void rows_to_ranks(const Layout& layout, DepthView depth, const std::vector<int>* bands,
                   std::uint16_t* ranks, std::uint16_t* pixels, NewDepths& found) {
    HWY_DYNAMIC_DISPATCH(rows_to_ranks)(layout, depth, bands, ranks, pixels, found);
}
void steps_to_rows(const Layout& layout, const std::uint16_t* pixels, const std::uint16_t* depths,
                   MutableDepthView out) {
    HWY_DYNAMIC_DISPATCH(steps_to_rows)(layout, pixels, depths, out);
}
void sample_equations(const Model& model, const std::uint16_t* pixels, int limit,
                      Equations& equations) {
    HWY_DYNAMIC_DISPATCH(sample_equations)(model, pixels, limit, equations);
}

void shift_ranks(const std::uint16_t* from, std::size_t count, const std::uint16_t* bounds,
                 std::size_t bound_count, std::uint16_t* to) {
    HWY_DYNAMIC_DISPATCH(shift_ranks)(from, count, bounds, bound_count, to);
}

}  // namespace theatron::codec::strata
#endif
