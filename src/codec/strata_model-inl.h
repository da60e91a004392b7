// SPDX-License-Identifier: Apache-2.0
// One step of Strata's model for some of the lanes, in vectors of 16-bit values.
// Included once per instruction set, by strata_kernel.cpp.
//
// All arithmetic is modulo 2^16, so that each side gets equal results whatever
// the pixels are. docs/formats/strata.md has the same in words.

// No include guard: the namespace differs from one inclusion to the next.
#include "codec/strata_kernel.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::uint16_t, lane_count>;
using S16 = hn::RebindToSigned<D16>;
using D8 = hn::Rebind<std::uint8_t, D16>;
using V16 = hn::Vec<D16>;
using VS16 = hn::Vec<S16>;

// What the model remembers of the last eight steps, per lane.
enum Trace {
    error0,
    error1,
    error2,
    error3,
    triple0,
    triple1,
    triple2,
    triple3,
    activity,
    activity_above,
    trace_count
};
inline constexpr int first_delayed = triple0;  // those that lane 0 reads from lane 31

struct Traces {
    // Lanes from value trace_origin on, in front of them the lane above lane 0.
    static constexpr int trace_stride = 64, trace_origin = 32;
    alignas(64) std::uint16_t of[8][trace_count][trace_stride] = {};

    std::uint16_t* at(int step, int trace) { return of[step & 7][trace] + trace_origin; }
};

// Where each lane is in its row.
struct Positions {
    alignas(64) std::uint16_t x[lane_count];     // as in the image plus row_front; wraps below 0
    alignas(64) std::uint16_t rows[lane_count];  // rows left, signed; none at 0 and less
};

// The step's planes, and what is the same for all steps.
struct Step {
    const std::uint16_t* depth;  // at lane 0 of this step
    const std::uint8_t* valid;
    const std::uint16_t* reference_depth;
    const std::uint8_t* reference_valid;
    int index;
    bool inside;  // all lanes are at a pixel
};

// What the model says about the pixels of some lanes.
struct Prediction {
    V16 candidate[4];
    V16 depth;          // the prediction
    V16 context;        // idle_context where there is no pixel
    V16 flip;           // all bits set where differences have the opposite sign
    V16 active;         // all bits set where there is a pixel
    V16 outside_depth;  // what stands outside the image
    V16 outside_valid;
};

HWY_INLINE V16 load(const std::uint16_t* plane, int steps_ago, int lane) {
    return hn::LoadU(D16(), plane - std::ptrdiff_t(steps_ago) * plane_stride + lane);
}
HWY_INLINE V16 load(const std::uint8_t* plane, int steps_ago, int lane) {
    return hn::PromoteTo(D16(),
                         hn::LoadU(D8(), plane - std::ptrdiff_t(steps_ago) * plane_stride + lane));
}

HWY_INLINE V16 half_of_signed(V16 v) {
    return hn::BitCast(D16(), hn::ShiftRight<1>(hn::BitCast(S16(), v)));
}

HWY_INLINE V16 distance(V16 a, V16 b) {
    return hn::BitCast(D16(), hn::Abs(hn::BitCast(S16(), hn::Sub(a, b))));
}

HWY_INLINE V16 as_value(hn::Mask<D16> m) {
    return hn::VecFromMask(D16(), m);
}

template <bool temporal>
HWY_INLINE V16 linear_prediction(const Step& s, int lane, V16 mean, V16 left, V16 upper_left,
                                 V16 upper_right, const Weights& weights) {
    const auto term = [&](V16 pixel, int tap) HWY_ATTR {
        const VS16 difference = hn::BitCast(S16(), hn::ShiftLeft<3>(hn::Sub(pixel, mean)));
        return hn::MulFixedPoint15(difference, hn::Set(S16(), weights[tap]));
    };
    VS16 sum = hn::Set(S16(), 4);
    VS16 far = hn::Add(term(load(s.depth, 2, lane - 1), 5), term(load(s.depth, 8, lane - 2), 4));
    far = hn::Add(far, hn::Add(term(upper_left, 1), term(upper_right, 2)));
    if constexpr (temporal) {
        const std::uint16_t* r = s.reference_depth;
        sum = hn::Add(sum, hn::Add(term(load(r, 0, lane), 6), term(load(r, 1, lane), 7)));
        sum = hn::Add(sum, hn::Add(term(load(r, 4, lane - 1), 8), term(load(r, -1, lane), 9)));
        sum = hn::Add(sum, term(load(r, -4, lane + 1), 10));
    }
    sum = hn::Add(sum, hn::Add(far, term(load(s.depth, 2, lane), 3)));
    sum = hn::Add(sum, term(left, 0));
    return hn::Add(mean, hn::BitCast(D16(), hn::ShiftRight<3>(sum)));
}

// The candidate with the least error nearby, or the mean of the best two.
HWY_INLINE V16 choose(const V16 (&candidate)[4], const Step& s, Traces& traces, int lane) {
    const D16 d;
    V16 error[4];
    for (int i = 0; i < 4; ++i) {
        const V16 above = hn::LoadU(d, traces.at(s.index - 3, triple0 + i) + lane - 1);
        const V16 left = hn::Add(hn::LoadU(d, traces.at(s.index - 1, error0 + i) + lane),
                                 hn::LoadU(d, traces.at(s.index - 2, error0 + i) + lane));
        error[i] = hn::Add(above, left);
    }
    const auto second_of_01 = hn::Lt(error[1], error[0]);
    const auto second_of_23 = hn::Lt(error[3], error[2]);
    const V16 best_01 = hn::Min(error[0], error[1]), worse_01 = hn::Max(error[0], error[1]);
    const V16 best_23 = hn::Min(error[2], error[3]), worse_23 = hn::Max(error[2], error[3]);
    const V16 pick_01 = hn::IfThenElse(second_of_01, candidate[1], candidate[0]);
    const V16 other_01 = hn::IfThenElse(second_of_01, candidate[0], candidate[1]);
    const V16 pick_23 = hn::IfThenElse(second_of_23, candidate[3], candidate[2]);
    const V16 other_23 = hn::IfThenElse(second_of_23, candidate[2], candidate[3]);

    const auto later = hn::Lt(best_23, best_01);
    const V16 least = hn::Min(best_01, best_23);
    const V16 pick = hn::IfThenElse(later, pick_23, pick_01);
    const V16 loser = hn::IfThenElse(later, pick_01, pick_23);
    const V16 partner = hn::IfThenElse(later, other_23, other_01);
    const V16 loser_error = hn::Max(best_01, best_23);
    const V16 partner_error = hn::IfThenElse(later, worse_23, worse_01);
    const V16 next = hn::IfThenElse(hn::Lt(partner_error, loser_error), partner, loser);
    const V16 next_error = hn::Min(partner_error, loser_error);

    const auto close =
        hn::Lt(hn::Add(next_error, next_error), hn::Add(least, hn::Add(least, least)));
    return hn::IfThenElse(close, hn::AverageRound(pick, next), pick);
}

template <bool temporal, bool blend>
HWY_INLINE Prediction predict(const Model& model, const Step& s, Traces& traces,
                              const Positions& positions, int lane) {
    const D16 d;
    const V16 one = hn::Set(d, 1);
    Prediction p;

    const V16 left = load(s.depth, 1, lane), above = load(s.depth, 4, lane - 1);
    const V16 upper_left = load(s.depth, 5, lane - 1), upper_right = load(s.depth, 3, lane - 1);
    const V16 low = hn::Min(left, above), high = hn::Max(left, above);
    const V16 gradient = hn::Add(left, hn::Sub(above, upper_left));
    const V16 median = hn::Max(low, hn::Min(high, gradient));
    const V16 mean = hn::AverageRound(left, above);
    const V16 linear =
        linear_prediction<temporal>(s, lane, mean, left, upper_left, upper_right, model.weights);
    p.depth = median;
    if constexpr (blend) {
        p.candidate[0] = median;
        if constexpr (temporal) {
            const V16 before = load(s.reference_depth, 0, lane);
            const V16 change = hn::Add(hn::Sub(left, load(s.reference_depth, 1, lane)),
                                       hn::Sub(above, load(s.reference_depth, 4, lane - 1)));
            p.candidate[1] = before;
            p.candidate[2] = hn::Add(before, half_of_signed(change));
        } else {
            p.candidate[1] = left;
            p.candidate[2] = above;
        }
        p.candidate[3] = linear;
        p.depth = choose(p.candidate, s, traces, lane);
    }

    // How far and to which side the linear predictor is.
    const V16 aside = hn::Sub(linear, p.depth);
    p.flip = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), aside)));
    const V16 how_far = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), aside)));
    const V16 side = hn::Add(hn::Min(how_far, one), hn::Min(hn::ShiftRight<2>(how_far), one));

    const V16 last = hn::LoadU(d, traces.at(s.index - 1, activity) + lane);
    const V16 active = hn::Add(hn::Add(last, last),
                               hn::LoadU(d, traces.at(s.index - 3, activity_above) + lane - 1));
    V16 context = hn::Min(active, hn::Set(d, activity_bounds[2]));
    for (int i = 3; i < 9; ++i)
        context = hn::Sub(context, as_value(hn::Gt(active, hn::Set(d, activity_bounds[i] - 1))));
    context = hn::Add(hn::Add(context, hn::Add(context, context)), side);

    const V16 valid_left = load(s.valid, 1, lane), valid_above = load(s.valid, 4, lane - 1);
    const V16 valid_upper_left = load(s.valid, 5, lane - 1);
    const V16 valid_upper_right = load(s.valid, 3, lane - 1);
    const V16 direct = hn::Add(valid_left, valid_above);
    const V16 around =
        hn::Add(hn::Add(direct, direct), hn::Add(valid_upper_left, valid_upper_right));
    V16 before = hn::Set(d, 3);
    if constexpr (temporal) {
        const V16 same = load(s.reference_valid, 0, lane);
        before = hn::Add(hn::Add(same, same), hn::And(load(s.reference_valid, -1, lane),
                                                      load(s.reference_valid, -4, lane + 1)));
    }
    const V16 neighbourhood = hn::Add(hn::ShiftLeft<2>(around), before);
    context = hn::IfThenElse(hn::Eq(neighbourhood, hn::Set(d, 27)), context,
                             hn::Add(neighbourhood, hn::Set(d, mixed_contexts)));

    p.context = context;
    p.active = hn::Set(d, 0xffff);
    p.outside_depth = above;
    p.outside_valid = valid_above;
    if (HWY_UNLIKELY(!s.inside)) {
        const V16 x = hn::Load(d, positions.x + lane);
        const V16 rows = hn::Load(d, positions.rows + lane);
        const auto in_rows = hn::RebindMask(d, hn::Gt(hn::BitCast(S16(), rows), hn::Zero(S16())));
        const auto in_columns = hn::Lt(hn::Sub(x, hn::Set(d, row_front)),
                                       hn::Set(d, std::uint16_t(model.layout.size.width)));
        const auto is_pixel = hn::And(in_rows, in_columns);
        p.active = as_value(is_pixel);
        p.context = hn::IfThenElse(is_pixel, context, hn::Set(d, idle_context));

        // Left of the image stands what is above right, right of it the last pixel,
        // below it the row above.
        const auto before_row = hn::Lt(x, hn::Set(d, row_front));
        p.outside_depth =
            hn::IfThenElse(in_rows, hn::IfThenElse(before_row, upper_right, left), above);
        p.outside_valid = hn::IfThenElse(
            in_rows, hn::IfThenElse(before_row, valid_upper_right, valid_left), valid_above);
    }
    return p;
}

// Keeps what later steps need. `depth` is final also for holes and outside.
template <bool blend>
HWY_INLINE void keep(const V16 (&candidate)[4], V16 depth, V16 residual, V16 is_active, V16 valid,
                     std::uint16_t* depth_out, std::uint8_t* valid_out, Traces& traces, int index,
                     int lane) {
    const D16 d;
    const V16 most = hn::Set(d, 255);
    hn::StoreU(depth, d, depth_out + lane);
    hn::StoreU(hn::DemoteTo(D8(), hn::BitCast(S16(), valid)), D8(), valid_out + lane);
    if constexpr (blend) {
        for (int i = 0; i < 4; ++i) {
            const V16 error = hn::And(hn::Min(distance(depth, candidate[i]), most), is_active);
            const V16 triple =
                hn::Add(error, hn::Add(hn::LoadU(d, traces.at(index - 1, error0 + i) + lane),
                                       hn::LoadU(d, traces.at(index - 2, error0 + i) + lane)));
            hn::StoreU(error, d, traces.at(index, error0 + i) + lane);
            hn::StoreU(triple, d, traces.at(index, triple0 + i) + lane);
        }
    }
    const V16 size = hn::Min(residual, most);
    const V16 before = hn::LoadU(d, traces.at(index - 1, activity) + lane);
    const V16 above = hn::Add(hn::Add(size, hn::Add(before, before)),
                              hn::LoadU(d, traces.at(index - 2, activity) + lane));
    hn::StoreU(size, d, traces.at(index, activity) + lane);
    hn::StoreU(above, d, traces.at(index, activity_above) + lane);
}

// Moves all lanes on by one position.
HWY_INLINE void advance(Positions& positions, const Layout& layout) {
    const D16 d;
    const V16 last = hn::Set(d, std::uint16_t(layout.pitch - 1));
    for (std::size_t lane = 0; lane < lane_count; lane += hn::Lanes(d)) {
        const V16 x = hn::Load(d, positions.x + lane);
        const V16 rows = hn::Load(d, positions.rows + lane);
        const auto wraps = hn::Eq(x, last);
        hn::Store(hn::IfThenZeroElse(wraps, hn::Add(x, hn::Set(d, 1))), d, positions.x + lane);
        hn::Store(hn::Sub(rows, hn::IfThenElseZero(wraps, hn::Set(d, lane_count))), d,
                  positions.rows + lane);
    }
}

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
