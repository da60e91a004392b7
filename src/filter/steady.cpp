// SPDX-License-Identifier: Apache-2.0
#include "filter/steady.h"

#include <algorithm>
#include <cassert>

#include "image/scratch.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/steady.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// steady_step() and steady_block_moves() for vectors of pixels.
class SteadyLanes {
public:
    SteadyLanes(const SteadyRule& rule, int missed)
        : together_(rule.together),
          tolerance_constant_(u(rule.tolerance_constant)),
          tolerance_squared_(u(rule.tolerance_squared)),
          frames_(u(rule.frames)),
          most_hold_(u(rule.most_hold * steady_one_missing)),
          more_frames_(u(1 + smaller(missed, most_steady_frames))),
          count_bits_(u(steady_count_bits)),
          nearer_bit_(u(steady_nearer_bit)),
          one_missing_(u(steady_one_missing)),
          missing_bits_(u(0xff00)) {}

    // Fills `moves`, a row, for the blocks of rows `top` to `bottom`: all bits of the columns of
    // those that move. `sums` has two rows, for the sums of columns.
    void vote(const DepthPlane& in, const SteadyState& state, int top, int bottom, DepthPlane& sums,
              std::uint16_t* moves) const {
        const int width = in.padded_width();
        std::uint16_t *column_pixels = sums.row(0), *column_side = sums.row(1);
        for (int x = 0; x < width; x += int(hn::Lanes(du))) {
            auto pixels = hn::Zero(du), side = pixels;
            for (int y = top; y < bottom; ++y) {
                const auto measured = hn::LoadU(du, in.row(y) + x);
                const auto depth = hn::LoadU(du, state.depth.row(y) + x);
                const auto counts = tolerated(depth, measured);
                // A true mask is -1.
                pixels = hn::Sub(pixels, hn::VecFromMask(du, counts));
                const auto further = hn::And(counts, hn::Gt(measured, depth));
                const auto nearer = hn::And(counts, hn::Lt(measured, depth));
                side = hn::Sub(hn::Add(side, hn::VecFromMask(du, nearer)),
                               hn::VecFromMask(du, further));
            }
            hn::StoreU(pixels, du, column_pixels + x);
            hn::StoreU(side, du, column_side + x);
        }
        for (int left = 0; left < width; left += steady_block) {
            int pixels = 0, side = 0;
            for (int x = left; x < left + steady_block; ++x) {
                pixels += column_pixels[x];
                side += std::int16_t(column_side[x]);
            }
            const bool moved = pixels > 0 && larger(side, -side) * 100 >= together_ * pixels;
            std::fill_n(moves + left, steady_block, std::uint16_t(moved ? 0xffff : 0));
        }
    }

    // Advances the state of row `y`. Not inlined, for the same reason as that of Kalman.
    HWY_NOINLINE void step(const DepthPlane& in, const std::uint16_t* moves, SteadyState& state,
                           int y) const {
        const auto zero = hn::Zero(du);
        const std::uint16_t* measured_row = in.row(y);
        std::uint16_t *depth_row = state.depth.row(y), *run_row = state.run.row(y);
        for (int x = 0; x < in.padded_width(); x += int(hn::Lanes(du))) {
            const auto measured = hn::LoadU(du, measured_row + x);
            const auto depth = hn::LoadU(du, depth_row + x);
            const auto run = hn::LoadU(du, run_row + x);

            const auto side = hn::IfThenElseZero(hn::Lt(measured, depth), nearer_bit_);
            const auto same_side = hn::Eq(hn::And(run, nearer_bit_), side);
            const auto count =
                hn::Add(hn::IfThenElseZero(same_side, hn::And(run, count_bits_)), more_frames_);
            const auto waits =
                hn::AndNot(hn::Eq(measured, depth),
                           hn::AndNot(hn::MaskFromVec(hn::LoadU(du, moves + x)),
                                      hn::And(tolerated(depth, measured), hn::Lt(count, frames_))));
            const auto held = hn::And(hn::And(hn::Eq(measured, zero), hn::Ne(depth, zero)),
                                      hn::Lt(hn::And(run, missing_bits_), most_hold_));
            const auto next_run = hn::IfThenElse(held, hn::Add(run, one_missing_),
                                                 hn::IfThenElseZero(waits, hn::Or(count, side)));
            hn::StoreU(hn::IfThenElse(hn::Or(waits, held), depth, measured), du, depth_row + x);
            hn::StoreU(next_run, du, run_row + x);
        }
    }

private:
    using DU = hn::ScalableTag<std::uint16_t>;
    static constexpr DU du{};
    using VU = hn::Vec<DU>;
    static VU u(int value) { return hn::Set(du, std::uint16_t(value)); }

    // Measured before and now, and within the tolerance.
    HWY_INLINE hn::Mask<DU> tolerated(VU depth, VU measured) const {
        const auto tolerance = hn::SaturatedAdd(
            tolerance_constant_, hn::MulHigh(hn::MulHigh(depth, depth), tolerance_squared_));
        const auto distance =
            hn::Or(hn::SaturatedSub(measured, depth), hn::SaturatedSub(depth, measured));
        return hn::And(at_most(distance, tolerance),
                       hn::Ne(hn::Min(measured, depth), hn::Zero(du)));
    }

    int together_;
    VU tolerance_constant_, tolerance_squared_;
    VU frames_, most_hold_, more_frames_;
    VU count_bits_, nearer_bit_, one_missing_, missing_bits_;
};

void steady_rows(const DepthPlane& in, const SteadyRule& rule, int missed, SteadyState& state,
                 DepthPlane& sums) {
    std::uint16_t* const moves = sums.row(2);
    const SteadyLanes steady(rule, missed);
    const int height = in.size().height;
    for (int top = 0; top < height; top += steady_block) {
        const int bottom = smaller(top + steady_block, height);
        steady.vote(in, state, top, bottom, sums, moves);
        for (int y = top; y < bottom; ++y)
            steady.step(in, moves, state, y);
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(steady_rows);

void apply_steady(const DepthPlane& in, const SteadyRule& rule, int missed, SteadyState& state) {
    assert(in.size() == state.depth.size());
    auto& sums = scratch_of_this_thread<DepthPlane>({in.size().width, 3});
    HWY_DYNAMIC_DISPATCH(steady_rows)(in, rule, missed, state, sums);
}

}  // namespace theatron::filter
#endif
