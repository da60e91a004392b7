// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_kernel.h"

#include <cstring>
#include <vector>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "codec/strata_kernel.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// In this order: each uses the one before.
#include "codec/strata_model-inl.h"

#include "codec/strata_coder-inl.h"

#include "codec/strata_skew-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {

// Everything that walks over the steps: the planes, the traces, and the rows of
// lane 31 that lane 0 will need.
class Walk {
public:
    explicit Walk(const Model& model) : model_(model), delay_(model.layout.delay()) {
        for (int lane = 0; lane < lane_count; ++lane) {
            positions.x[lane] = std::uint16_t(-skew * lane);
            positions.rows[lane] = std::uint16_t(model.layout.size.height - lane);
        }
        delayed_.resize(std::size_t(delay_) * (trace_count - first_delayed));
        const std::size_t margin = std::size_t(plane_margin) * plane_stride;
        const std::size_t end = model.layout.plane_values() - margin;
        std::memset(model.depth, 0, margin * sizeof(*model.depth));
        std::memset(model.depth + end, 0, margin * sizeof(*model.depth));
        std::memset(model.valid, 0, margin);
        std::memset(model.valid + end, 0, margin);
    }

    // Prepares the step's copies of lanes of other groups.
    Step begin(int index) {
        const std::size_t at = std::size_t(index + plane_margin) * plane_stride + plane_origin;
        Step step{model_.depth + at,
                  model_.valid + at,
                  model_.reference_depth,
                  model_.reference_valid,
                  index,
                  is_inside(index)};
        if (step.reference_depth != nullptr) {
            step.reference_depth += at;
            step.reference_valid += at;
        }
        depth = model_.depth + at;
        valid = model_.valid + at;
        const std::ptrdiff_t back = std::ptrdiff_t(delay_) * plane_stride;
        constexpr std::size_t front = plane_origin,
                              behind = plane_stride - plane_origin - lane_count;
        if (index >= delay_) {
            std::memcpy(depth - front, depth + lane_count - front - back, front * sizeof(*depth));
            std::memcpy(valid - front, valid + lane_count - front - back, front);
        } else {
            std::memset(depth - front, 0, front * sizeof(*depth));
            std::memset(valid - front, 0, front);
        }
        std::memset(depth + lane_count, 0, behind * sizeof(*depth));
        std::memset(valid + lane_count, 0, behind);
        const std::uint16_t* above = delayed(index);
        for (int i = first_delayed; i < trace_count; ++i)
            traces.at(index, i)[-1] = above[i - first_delayed];
        return step;
    }

    // Ends a step. What other groups need of it is copied a few steps later,
    // when it has left the processor's store queue.
    void end(int index) {
        copy_lanes(index - copy_lag);
        advance(positions, model_.layout);
    }

    void finish() {
        for (int i = copy_lag - 1; i >= 0; --i)
            copy_lanes(model_.layout.steps - 1 - i);
    }

    Traces traces;
    Positions positions;
    std::uint16_t* depth = nullptr;
    std::uint8_t* valid = nullptr;

private:
    static constexpr int copy_lag = 4;
    static_assert(copy_lag < least_delay);

    bool is_inside(int index) const {
        const Layout& layout = model_.layout;
        const int x = index % layout.pitch - row_front;  // of lane 0
        return x >= skew * (lane_count - 1) && x < layout.size.width &&
               (index / layout.pitch + 1) * lane_count <= layout.size.height;
    }

    std::uint16_t* delayed(int index) {
        return delayed_.data() + std::size_t(index % delay_) * (trace_count - first_delayed);
    }

    void copy_lanes(int index) {
        if (index < 0)
            return;
        std::uint16_t* to = delayed(index);
        for (int i = first_delayed; i < trace_count; ++i)
            to[i - first_delayed] = traces.at(index, i)[lane_count - 1];
        if (index < delay_)
            return;
        const std::size_t from = std::size_t(index + plane_margin) * plane_stride + plane_origin;
        const std::size_t copy = from + lane_count - std::size_t(delay_) * plane_stride;
        model_.depth[copy] = model_.depth[from];
        model_.valid[copy] = model_.valid[from];
    }

    const Model& model_;
    int delay_;
    std::vector<std::uint16_t> delayed_;
};

// The code of each difference as a token, and its further bits.
HWY_INLINE void tokens_of(V16 code, V16& token, V16& extra) {
    const D16 d;
    token = hn::Add(code, hn::Set(d, first_token));
    extra = hn::Zero(d);
    const auto is_long = hn::Gt(code, hn::Set(d, direct_tokens - 1));
    if (HWY_LIKELY(hn::AllFalse(d, is_long)))
        return;
    alignas(64) std::uint16_t codes[hn::MaxLanes(d)], tokens[hn::MaxLanes(d)],
        extras[hn::MaxLanes(d)];
    hn::Store(code, d, codes);
    const D32 d32;
    const V32 one = hn::Set(d32, 1);
    for (std::size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(d32)) {
        // As a floating-point number a code shows its highest bit in the
        // exponent, and the next one in front of the rest of the mantissa.
        const V32 wide = load32(codes + i);
        const V32 as_float = hn::BitCast(d32, hn::ConvertTo(F32(), hn::BitCast(S32(), wide)));
        const V32 halves = hn::Sub(hn::ShiftRight<22>(as_float), hn::Set(d32, 2 * 127));
        const V32 bits = hn::Sub(hn::ShiftRight<1>(halves), one);
        const V32 low = hn::And(wide, hn::Sub(hn::Shl(one, hn::And(bits, hn::Set(d32, 15))), one));
        store16(hn::And(hn::Add(halves, hn::Set(d32, first_long_token - 9)), hn::Set(d32, 0xffff)),
                tokens + i);
        store16(low, extras + i);
    }
    token = hn::IfThenElse(is_long, hn::Load(d, tokens), token);
    extra = hn::IfThenElseZero(is_long, hn::Load(d, extras));
}

template <bool temporal, bool blend, bool lossy>
void encode_steps(const Model& model, std::uint16_t* pixels, const CodedPixels& coded) {
    const D16 d;
    Walk walk(model);
    for (int t = 0; t < model.layout.steps; ++t) {
        const Step step = walk.begin(t);
        for (int lane = 0; lane < lane_count; lane += int(hn::Lanes(d))) {
            const std::size_t at = std::size_t(t) * lane_count + lane;
            const Prediction p =
                predict<temporal, blend>(model, step, walk.traces, walk.positions, lane);
            V16 depth = hn::LoadU(d, pixels + at);
            const auto is_pixel = hn::MaskFromVec(p.active);
            const auto is_hole = hn::Eq(depth, hn::Zero(d));
            const auto is_top = hn::Eq(depth, hn::Set(d, 0xffff));
            const auto is_measured = hn::AndNot(hn::Or(is_hole, is_top), is_pixel);

            V16 difference = hn::IfThenElseZero(is_measured, hn::Sub(depth, p.depth));
            V16 token, extra;
            if constexpr (lossy) {
                const Quantised q = quantise(model, p.depth, depth, is_measured, model.region + at);
                difference = q.difference;
                depth = q.depth;
                tokens_of(zigzag(hn::Sub(hn::Xor(difference, p.flip), p.flip)), token, extra);
                token = hn::IfThenElse(q.is_literal, q.literal_token, token);
                extra = hn::IfThenElse(q.is_literal, q.literal, extra);
                hn::StoreU(depth, d, pixels + at);
            } else {
                tokens_of(zigzag(hn::Sub(hn::Xor(difference, p.flip), p.flip)), token, extra);
            }
            token = hn::IfThenElse(is_hole, hn::Set(d, hole_token), token);
            token = hn::IfThenElse(is_top, hn::Set(d, top_token), token);
            token = hn::IfThenElseZero(is_pixel, token);
            hn::StoreU(hn::Add(hn::ShiftLeft<6>(p.context), token), d, coded.token + at);
            hn::StoreU(hn::IfThenElseZero(is_measured, extra), d, coded.extra + at);

            const V16 size = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), difference)));
            depth = hn::IfThenElse(is_measured, depth,
                                   hn::IfThenElse(is_pixel, p.depth, p.outside_depth));
            const V16 valid = hn::IfThenElse(
                is_pixel, hn::And(as_value(is_measured), hn::Set(d, 1)), p.outside_valid);
            keep<blend>(p.candidate, depth, size, p.active, valid, walk.depth, walk.valid,
                        walk.traces, t, lane);
        }
        walk.end(t);
    }
    walk.finish();
}

template <bool temporal, bool blend, bool lossy>
bool decode_steps_as(const Model& model, const SlotTable& slots, const Stream& stream,
                     std::uint16_t* pixels) {
    const D16 d;
    Walk walk(model);
    TokenReader reader(slots, stream);
    alignas(64) std::uint16_t candidates[4][lane_count], predicted[lane_count],
        contexts[lane_count], flips[lane_count], actives[lane_count], outside_depth[lane_count],
        outside_valid[lane_count], tokens[lane_count], codes[lane_count];
    for (int t = 0; t < model.layout.steps; ++t) {
        const Step step = walk.begin(t);
        for (int lane = 0; lane < lane_count; lane += int(hn::Lanes(d))) {
            const Prediction p =
                predict<temporal, blend>(model, step, walk.traces, walk.positions, lane);
            if constexpr (blend) {
                for (int i = 0; i < 4; ++i)
                    hn::Store(p.candidate[i], d, candidates[i] + lane);
            }
            hn::Store(p.depth, d, predicted + lane);
            hn::Store(p.context, d, contexts + lane);
            hn::Store(p.flip, d, flips + lane);
            hn::Store(p.active, d, actives + lane);
            hn::Store(p.outside_depth, d, outside_depth + lane);
            hn::Store(p.outside_valid, d, outside_valid + lane);
        }
        if (!reader.read(contexts, tokens, codes))
            return false;
        for (int lane = 0; lane < lane_count; lane += int(hn::Lanes(d))) {
            const V16 prediction = hn::Load(d, predicted + lane);
            const V16 flip = hn::Load(d, flips + lane);
            const V16 token = hn::Load(d, tokens + lane);
            const V16 code = hn::Load(d, codes + lane);
            const V16 is_active = hn::Load(d, actives + lane);
            const auto is_pixel = hn::MaskFromVec(is_active);
            const auto is_hole = hn::Lt(token, hn::Set(d, literal_low_token));
            const auto is_measured = hn::AndNot(is_hole, is_pixel);

            V16 difference = hn::Sub(hn::Xor(unzigzag(code), flip), flip);
            difference = hn::IfThenElseZero(is_measured, difference);
            const V16 size = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), difference)));
            V16 depth;
            if constexpr (lossy) {
                const V16 width = step_width(model, prediction,
                                             model.region + std::size_t(t) * lane_count + lane);
                depth = hn::Add(prediction, hn::Mul(difference, width));
            } else {
                depth = hn::Add(prediction, difference);
            }
            V16 kept_size = size;
            if constexpr (lossy) {
                const auto is_literal = hn::Or(hn::Eq(token, hn::Set(d, literal_low_token)),
                                               hn::Eq(token, hn::Set(d, literal_high_token)));
                depth = hn::IfThenElse(is_literal, code, depth);
                kept_size = hn::IfThenElse(is_literal, hn::Set(d, 255), size);
            }
            // Neither of the two kinds of hole may come out of a difference.
            const V16 measured_depth = depth;
            const V16 hole =
                hn::IfThenElseZero(hn::Eq(token, hn::Set(d, top_token)), hn::Set(d, 0xffff));
            hn::StoreU(hn::IfThenElse(is_measured, measured_depth, hole), d,
                       pixels + std::size_t(t) * lane_count + lane);

            depth = hn::IfThenElse(
                is_measured, measured_depth,
                hn::IfThenElse(is_pixel, prediction, hn::Load(d, outside_depth + lane)));
            const V16 valid =
                hn::IfThenElse(is_pixel, hn::And(as_value(is_measured), hn::Set(d, 1)),
                               hn::Load(d, outside_valid + lane));
            V16 candidate[4];
            if constexpr (blend) {
                for (int i = 0; i < 4; ++i)
                    candidate[i] = hn::Load(d, candidates[i] + lane);
            }
            keep<blend>(candidate, depth, kept_size, is_active, valid, walk.depth, walk.valid,
                        walk.traces, t, lane);
        }
        walk.end(t);
    }
    walk.finish();
    return reader.at_end();
}

void encode_model(const Model& model, std::uint16_t* pixels, const CodedPixels& coded) {
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
HWY_EXPORT(sample_equations);
HWY_EXPORT(shift_ranks);

void encode_model(const Model& model, std::uint16_t* pixels, const CodedPixels& coded) {
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
void steps_to_rows(const Layout& layout, const std::uint16_t* pixels, MutableDepthView depth) {
    HWY_DYNAMIC_DISPATCH(steps_to_rows)(layout, pixels, depth);
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
