// SPDX-License-Identifier: Apache-2.0
// One step of Strata's model for one vector (part) of the 32 lanes.
// Included once per instruction set, by strata_kernel.cpp.
//
// All arithmetic is modulo 2^16, so that encoder and decoder get equal results for
// any pixels. docs/formats/depth_strata.md specifies the model.

// No include guard: the namespace differs from one inclusion to the next.
#include <algorithm>
#include <cstring>

#include "codec/strata_kernel.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Values of a step that the row below reads three steps later, one lane further.
// Without blend only the first kind is kept.
enum Trace { marks_above, triple0, triple1, triple2, triple3, trace_count };

// A mark packs the residual of a pixel (at most 255) and a flag for "measured" into
// one number. The sum of up to six marks holds both sums: residuals in the low 12
// bits, the count of measured pixels above.
inline constexpr std::uint16_t measured_mark = 1 << 12;

struct Traces {
    // Lane 0 is at trace_origin; the value in front of it belongs to the lane above.
    static constexpr int trace_stride = 64, trace_origin = 32;
    alignas(64) std::uint16_t of[8][trace_count][trace_stride] = {};

    std::uint16_t* at(int step, int trace) { return of[step & 7][trace] + trace_origin; }
};

// Pointers to lane 0 of one step in the planes, and the position of lane 0.
struct Step {
    std::uint16_t* depth;
    std::uint64_t* valid;
    const std::uint16_t* reference_depth;
    const std::uint64_t* reference_valid;
    int index;
    int position, group;  // of lane 0
    bool inside;          // all lanes are at a pixel
};

// State that the lanes of a part carry from step to step: neighbours to the left,
// neighbours above that were already loaded, and the errors of recent predictions.
// A suffix 8 means eight times the depth.
struct Window {
    V16 left, left8, far_left8;
    V16 upper_left, upper8[3];  // upper8: upper right, above, upper left
    V16 before, before_left;    // in the reference
    V16 before8[2];
    V16 mark[2], two_marks;       // marks of the last two steps; twice the last one
    V16 error[4], two_errors[4];  // per candidate: of the last step; sum of the last two
};

// The model's output for the pixels of a part.
struct Prediction {
    V16 candidate[4];
    V16 depth;    // the prediction
    V16 context;  // assumes that every position is a pixel
    V16 flip;     // all bits set where the difference is coded with the opposite sign
};

HWY_INLINE V16 load(const std::uint16_t* plane, int steps_ago, int lane) {
    return hn::LoadU(D16(), plane - std::ptrdiff_t(steps_ago) * plane_stride + lane);
}

HWY_INLINE V16 half_of_signed(V16 v) {
    return hn::BitCast(D16(), hn::ShiftRight<1>(hn::BitCast(S16(), v)));
}

HWY_INLINE V16 distance(V16 a, V16 b) {
    return hn::BitCast(D16(), hn::Abs(hn::BitCast(S16(), hn::Sub(a, b))));
}

using LinearWeights = VS16[tap_count];

// `at` is the mean of left and upper neighbour; taps count relative to it.
template <bool temporal>
HWY_INLINE V16 linear_prediction(const Step& s, int lane, const Window& w, V16 at, V16 next8,
                                 V16 before_right8, const LinearWeights& weights) {
    const V16 at8 = hn::ShiftLeft<3>(at);
    const auto term = [&](V16 pixel8, int tap) HWY_ATTR {
        return hn::MulFixedPoint15(hn::BitCast(S16(), hn::Sub(pixel8, at8)), weights[tap]);
    };
    const auto load8 = [&](const std::uint16_t* plane, int steps_ago, int lane_at)
                           HWY_ATTR { return hn::ShiftLeft<3>(load(plane, steps_ago, lane_at)); };
    VS16 sum = hn::Set(S16(), 4);
    VS16 far = hn::Add(term(next8, 5), term(load8(s.depth, 8, lane - 2), 4));
    far = hn::Add(far, hn::Add(term(w.upper8[2], 1), term(w.upper8[0], 2)));
    if constexpr (temporal) {
        const std::uint16_t* r = s.reference_depth;
        sum = hn::Add(sum, hn::Add(term(w.before8[0], 6), term(w.before8[1], 7)));
        sum = hn::Add(sum, hn::Add(term(load8(r, 4, lane - 1), 8), term(before_right8, 9)));
        sum = hn::Add(sum, term(load8(r, -4, lane + 1), 10));
    }
    sum = hn::Add(sum, hn::Add(far, term(w.far_left8, 3)));
    sum = hn::Add(sum, term(w.left8, 0));
    return hn::Add(at, hn::BitCast(D16(), hn::ShiftRight<3>(sum)));
}

// Exchanges the lanes of two vectors where the mask is set. AVX2 chooses between two vectors
// slowly; SSE 4 and AVX-512 do not.
HWY_INLINE void exchange(hn::Mask<D16> where, V16& a, V16& b) {
#if HWY_TARGET == HWY_AVX2
    const V16 difference = hn::IfThenElseZero(where, hn::Xor(a, b));
    a = hn::Xor(a, difference);
    b = hn::Xor(b, difference);
#else
    const V16 first = hn::IfThenElse(where, b, a);
    b = hn::IfThenElse(where, a, b);
    a = first;
#endif
}

// The candidate with the least error on the neighbours, or the mean of the best two.
HWY_INLINE V16 choose(const V16 (&candidate)[4], const Step& s, const Window& w, Traces& traces,
                      int lane) {
    const D16 d;
    V16 error[4];
    for (int i = 0; i < 4; ++i)
        error[i] =
            hn::Add(w.two_errors[i], hn::LoadU(d, traces.at(s.index - 3, triple0 + i) + lane - 1));
    const auto second_of_01 = less(error[1], error[0]);
    const auto second_of_23 = less(error[3], error[2]);
    const V16 best_01 = hn::Min(error[0], error[1]), worse_01 = hn::Max(error[0], error[1]);
    const V16 best_23 = hn::Min(error[2], error[3]), worse_23 = hn::Max(error[2], error[3]);
    // The better one of each pair, and the other; then the best one of all, and that of the other
    // pair.
    V16 pick = candidate[0], other_01 = candidate[1], loser = candidate[2], other_23 = candidate[3];
    exchange(second_of_01, pick, other_01);
    exchange(second_of_23, loser, other_23);

    const auto later = less(best_23, best_01);
    const V16 least = hn::Min(best_01, best_23);
    exchange(later, pick, loser);
    const V16 partner = hn::IfThenElse(later, other_23, other_01);
    const V16 loser_error = hn::Max(best_01, best_23);
    const V16 partner_error = hn::IfThenElse(later, worse_23, worse_01);
    const V16 next = hn::IfThenElse(less(partner_error, loser_error), partner, loser);
    const V16 next_error = hn::Min(partner_error, loser_error);

    const auto close = less(hn::Add(next_error, next_error), hn::Add(least, hn::Add(least, least)));
    return hn::IfThenElse(close, hn::AverageRound(pick, next), pick);
}

// 3 times the number of activity_bounds that are not above the activity.
constexpr std::uint8_t activity_part(unsigned activity) {
    unsigned part = 0;
    for (const std::uint16_t bound : activity_bounds)
        part += activity >= bound ? 3 : 0;
    return std::uint8_t(part);
}

// The same as table look-ups: the sum of low[min(activity, 15)], high[min(activity / 8,
// 15)] and 3 for the last bound. `side` maps the distance between the linear predictor
// and the prediction to 0, 1 or 2.
struct ContextTables {
    alignas(16) std::uint8_t low[16] = {}, high[16] = {}, side[16] = {};
    constexpr ContextTables() {
        for (unsigned i = 0; i < 16; ++i) {
            low[i] = activity_part(i);
            high[i] =
                i < 2 ? std::uint8_t(0) : std::uint8_t(activity_part(8 * i) - activity_part(15));
            side[i] = i >= 4 ? 2 : i >= 1 ? 1 : 0;
        }
    }
};
inline constexpr ContextTables context_tables;
static_assert(activity_bounds[5] % 8 == 0 && activity_bounds[6] % 8 == 0 &&
              activity_bounds[7] % 8 == 0 && activity_bounds[8] >= 128);

// The context of a pixel whose neighbours were all measured.
HWY_INLINE V16 level_of(V16 activity, V16 how_far) {
    const D16 d;
#if HWY_TARGET == HWY_SCALAR
    const unsigned far = hn::GetLane(how_far);
    return hn::Set(d, std::uint16_t(activity_part(hn::GetLane(activity)) +
                                    context_tables.side[std::min(far, 15u)]));
#else
    const hn::Repartition<std::uint8_t, D16> d8;
    const V16 most = hn::Set(d, 15);
    const auto look_up = [&](const std::uint8_t* table, V16 index) HWY_ATTR {
        const auto bytes = hn::BitCast(d8, hn::Min(index, most));
        return hn::BitCast(d, bytes_at(hn::LoadDup128(d8, in_memory(table)), bytes));
    };
    const V16 side = look_up(context_tables.side, how_far);
    const V16 part = hn::Add(look_up(context_tables.low, activity),
                             look_up(context_tables.high, hn::ShiftRight<3>(activity)));
    const auto is_last = less(hn::Set(d, activity_bounds[8] - 1), activity);
    return hn::Add(hn::Add(part, side), hn::IfThenElseZero(is_last, hn::Set(d, 3)));
#endif
}

template <bool temporal>
HWY_INLINE Window begin_window(const Step& s, int lane) {
    const V16 zero = hn::Zero(D16());
    Window w;
    w.left = w.left8 = w.far_left8 = w.upper_left = zero;
    w.before = w.before_left = w.before8[0] = w.before8[1] = zero;
    for (V16& pixel : w.upper8)
        pixel = zero;
    w.mark[0] = w.mark[1] = w.two_marks = zero;
    for (int i = 0; i < 4; ++i)
        w.error[i] = w.two_errors[i] = zero;
    if constexpr (temporal) {
        w.before = load(s.reference_depth, 0, lane);
        w.before8[0] = hn::ShiftLeft<3>(w.before);
    }
    return w;
}

template <bool temporal, bool blend>
HWY_INLINE Prediction predict(const LinearWeights& weights, const Step& s, Traces& traces,
                              Window& w, int lane) {
    const D16 d;
    Prediction p;

    const V16 above = load(s.depth, 4, lane - 1);
    const V16 next8 = hn::ShiftLeft<3>(load(s.depth, 2, lane - 1));
    const V16 low = hn::Min(w.left, above), high = hn::Max(w.left, above);
    const V16 gradient = hn::Add(w.left, hn::Sub(above, w.upper_left));
    const V16 median = hn::Max(low, hn::Min(high, gradient));
    V16 before_right{}, before_right8{};
    if constexpr (temporal) {
        before_right = load(s.reference_depth, -1, lane);
        before_right8 = hn::ShiftLeft<3>(before_right);
    }
    const V16 linear = linear_prediction<temporal>(s, lane, w, hn::AverageRound(w.left, above),
                                                   next8, before_right8, weights);
    p.depth = median;
    if constexpr (blend) {
        p.candidate[0] = median;
        if constexpr (temporal) {
            const V16 change = hn::Add(hn::Sub(w.left, w.before_left),
                                       hn::Sub(above, load(s.reference_depth, 4, lane - 1)));
            p.candidate[1] = w.before;
            p.candidate[2] = hn::Add(w.before, half_of_signed(change));
        } else {
            p.candidate[1] = w.left;
            p.candidate[2] = above;
        }
        p.candidate[3] = linear;
        p.depth = choose(p.candidate, s, w, traces, lane);
    }

    // The sign and size of the difference between linear predictor and prediction.
    const V16 aside = hn::Sub(linear, p.depth);
    p.flip = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), aside)));
    const V16 how_far = hn::BitCast(d, hn::Abs(hn::BitCast(S16(), aside)));
    const V16 marks =
        hn::Add(w.two_marks, hn::LoadU(d, traces.at(s.index - 3, marks_above) + lane - 1));
    const V16 activity = hn::And(marks, hn::Set(d, measured_mark - 1));
    const V16 level = level_of(activity, how_far);

    // True if all marks of the neighbourhood and the reference's pixels are measured.
    auto is_whole = less(hn::Set(d, 6 * measured_mark - 1), marks);
    V16 neighbourhood = hn::Add(hn::And(hn::ShiftRight<10>(marks), hn::Set(d, 7 << 2)),
                                hn::Set(d, mixed_contexts + (temporal ? 0 : 3)));
    if constexpr (temporal) {
        const int bit = plane_origin + lane;
        const auto same = mask_of(s.reference_valid[0] >> bit);
        const auto beside =
            mask_of((s.reference_valid[1] >> bit) & (s.reference_valid[4] >> (bit + 1)));
        neighbourhood = hn::Add(neighbourhood, hn::IfThenElseZero(same, hn::Set(d, 2)));
        neighbourhood = hn::Add(neighbourhood, hn::IfThenElseZero(beside, hn::Set(d, 1)));
        is_whole = hn::And(is_whole, hn::And(same, beside));
    }
    p.context = hn::IfThenElse(is_whole, level, neighbourhood);

    w.upper_left = above;
    w.upper8[2] = w.upper8[1];
    w.upper8[1] = w.upper8[0];
    w.upper8[0] = next8;
    if constexpr (temporal) {
        w.before_left = w.before;
        w.before = before_right;
        w.before8[1] = w.before8[0];
        w.before8[0] = before_right8;
    }
    return p;
}

// The values stored at positions outside the image, for parts that have some.
struct Outside {
    hn::Mask<D16> is_pixel, valid;
    V16 depth;
};

// Left of the image: the value at upper right. Right of it: the last pixel. Below it:
// the value above. `left` is as before predict(). (Takes single fields of Step: a
// reference to Step would force it into memory.)
HWY_NOINLINE Outside outside_of(const Layout& layout, int position, int group,
                                const std::uint16_t* depth, const std::uint64_t* valid, V16 left,
                                int lane) {
    const D16 d;
    const V16 lanes = hn::Iota(d, std::uint16_t(lane));
    V16 x = hn::Sub(hn::Set(d, std::uint16_t(position)), hn::ShiftLeft<2>(lanes));
    // Lanes that are still in their row of the previous group.
    const V16 is_behind = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(S16(), x)));
    V16 rows = hn::Sub(hn::Set(d, std::uint16_t(layout.size.height - lane_count * group)), lanes);
    if (group > 0) {
        x = hn::Add(x, hn::And(is_behind, hn::Set(d, std::uint16_t(layout.pitch))));
        rows = hn::Add(rows, hn::And(is_behind, hn::Set(d, lane_count)));
    }
    const auto in_rows = hn::RebindMask(d, hn::Gt(hn::BitCast(S16(), rows), hn::Zero(S16())));
    const auto in_columns =
        hn::Lt(hn::Sub(x, hn::Set(d, row_front)), hn::Set(d, std::uint16_t(layout.size.width)));
    const auto before_row = hn::Lt(x, hn::Set(d, row_front));
    Outside outside;
    outside.is_pixel = hn::And(in_rows, in_columns);
    const V16 in_row = hn::IfThenElse(before_row, load(depth, 3, lane - 1), left);
    outside.depth = hn::IfThenElse(in_rows, in_row, load(depth, 4, lane - 1));
    const std::uint64_t rows_bits = bits_of(in_rows), front_bits = bits_of(before_row);
    const auto valid_at = [&](int steps_ago, int of_lane) {
        return valid[-steps_ago] >> (plane_origin + of_lane);
    };
    const std::uint64_t in_row_bits =
        (front_bits & valid_at(3, lane - 1)) | (~front_bits & valid_at(1, lane));
    outside.valid = mask_of((rows_bits & in_row_bits) | (~rows_bits & valid_at(4, lane - 1)));
    return outside;
}

// The values of a step that later steps read. `depth` has holes filled.
struct Kept {
    V16 depth;
    V16 residual;            // 0 where nothing was measured
    hn::Mask<D16> measured;  // `valid` of the plane
};

// Replaces values outside the image and sets all predictors' errors there to 0.
HWY_INLINE void keep_outside(const Outside& outside, V16 (&candidate)[4], Kept& kept) {
    kept.depth = hn::IfThenElse(outside.is_pixel, kept.depth, outside.depth);
    kept.measured = hn::Or(hn::And(outside.is_pixel, kept.measured),
                           hn::AndNot(outside.is_pixel, outside.valid));
    for (V16& c : candidate)
        c = hn::IfThenElse(outside.is_pixel, c, kept.depth);
}

// Stores what later steps read and advances the window.
template <bool blend>
HWY_INLINE void keep(const V16 (&candidate)[4], const Kept& kept, const Step& s, Traces& traces,
                     Window& w, int lane) {
    const D16 d;
    const V16 most = hn::Set(d, 255);
    hn::StoreU(kept.depth, d, s.depth + lane);
    *s.valid |= bits_of(kept.measured) << (plane_origin + lane);
    if constexpr (blend) {
        for (int i = 0; i < 4; ++i) {
            const V16 error = hn::Min(distance(kept.depth, candidate[i]), most);
            hn::StoreU(hn::Add(error, w.two_errors[i]), d, traces.at(s.index, triple0 + i) + lane);
            w.two_errors[i] = hn::Add(error, w.error[i]);
            w.error[i] = error;
        }
    }
    const V16 mark = hn::Add(hn::Min(kept.residual, most),
                             hn::IfThenElseZero(kept.measured, hn::Set(d, measured_mark)));
    hn::StoreU(hn::Add(hn::Add(mark, w.mark[1]), w.two_marks), d,
               traces.at(s.index, marks_above) + lane);
    w.mark[1] = w.mark[0];
    w.mark[0] = mark;
    w.two_marks = hn::Add(mark, mark);
    w.far_left8 = w.left8;
    w.left8 = hn::ShiftLeft<3>(kept.depth);
    w.left = kept.depth;
}

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
