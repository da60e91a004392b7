// SPDX-License-Identifier: Apache-2.0
// The definitions of the filters, pixel by pixel. Compiled without automatic vectorisation,
// as the baseline for the gain of SIMD.
#include <vector>

#include "filter/flying_pixels.h"
#include "filter/holes.h"
#include "filter/kalman.h"
#include "filter/limits.h"
#include "filter/speckles.h"
#include "filter/steady.h"

namespace theatron::filter {
namespace {

// Pixels of a plane as flags, false outside.
class Flags {
public:
    explicit Flags(Size size) : size_(size), flags_(size.area()) {}

    bool at(int x, int y) const { return inside(x, y) && flags_[index(x, y)]; }
    void set(int x, int y, bool value = true) { flags_[index(x, y)] = value; }
    bool inside(int x, int y) const {
        return x >= 0 && x < size_.width && y >= 0 && y < size_.height;
    }

private:
    std::size_t index(int x, int y) const {
        return std::size_t(y) * std::size_t(size_.width) + std::size_t(x);
    }
    Size size_;
    std::vector<std::uint8_t> flags_;
};

template <class Each>
void for_each_pixel(Size size, Each each) {
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            each(x, y);
}

// Pixels without measurement that are not covered by any square of side `side` without
// measurements.
Flags outside_large_holes(const DepthPlane& depth, int side) {
    const Size size = depth.size();
    const auto is_hole = [&](int x, int y) {
        return x < 0 || x >= size.width || y < 0 || y >= size.height || depth.row(y)[x] == none;
    };
    Flags covered(size);
    for (int top = 1 - side; top < size.height; ++top)
        for (int left = 1 - side; left < size.width; ++left) {
            bool all = true;
            for (int y = top; all && y < top + side; ++y)
                for (int x = left; all && x < left + side; ++x)
                    all = is_hole(x, y);
            for (int y = top; all && y < top + side; ++y)
                for (int x = left; x < left + side; ++x)
                    if (covered.inside(x, y))
                        covered.set(x, y);
        }
    Flags may_fill(size);
    for_each_pixel(size,
                   [&](int x, int y) { may_fill.set(x, y, is_hole(x, y) && !covered.at(x, y)); });
    return may_fill;
}

bool any_neighbour(const Flags& flags, int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if ((dx != 0 || dy != 0) && flags.at(x + dx, y + dy))
                return true;
    return false;
}

}  // namespace

void apply_limits_reference(DepthView in, const Limits& limits, DepthPlane& out) {
    for_each_pixel(in.size, [&](int x, int y) {
        const std::uint16_t depth = in.row(y)[x];
        const bool stays = depth >= limits.nearest && depth < limits.furthest.row(y)[x];
        out.row(y)[x] = stays ? depth : std::uint16_t(none);
    });
}

void remove_flying_pixels_reference(const DepthPlane& in, const FlyingPixelRule& rule,
                                    DepthPlane& out) {
    for_each_pixel(in.size(), [&](int x, int y) {
        out.row(y)[x] = supported_or_none(in.row(y) + x, in.pitch(), rule);
    });
}

void fill_holes_reference(DepthPlane& depth, const HoleRule& rule) {
    const Size size = depth.size();
    const Flags may_fill = outside_large_holes(depth, rule.max_size + 1);
    DepthPlane before = depth;
    const auto rim = [&](int x, int y) {
        return rim_of(before.row(y) + x, before.pitch(), rule.tolerance);
    };
    for (int i = 0; i < rule.iterations; ++i) {
        for_each_pixel(size, [&](int x, int y) {
            if (!may_fill.at(x, y) || before.row(y)[x] != none)
                return;
            const HoleRim around = rim(x, y);
            if (around.count >= rule.min_neighbours && !around.edge)
                depth.row(y)[x] = std::uint16_t(around.median);
        });
        before = depth;
    }

    Flags edge(size);
    for_each_pixel(size,
                   [&](int x, int y) { edge.set(x, y, may_fill.at(x, y) && rim(x, y).edge); });
    for (int i = 0; i < rule.iterations; ++i) {
        const Flags nearer = edge;
        for_each_pixel(size, [&](int x, int y) {
            if (may_fill.at(x, y) && any_neighbour(nearer, x, y))
                edge.set(x, y);
        });
    }
    for_each_pixel(size, [&](int x, int y) {
        if (edge.at(x, y))
            depth.row(y)[x] = none;
    });
}

void remove_speckles_reference(DepthPlane& depth, const SpeckleRule& rule) {
    struct Place {
        int x, y;
    };
    const Size size = depth.size();
    Flags seen(size);
    std::vector<Place> island;
    for_each_pixel(size, [&](int first_x, int first_y) {
        if (seen.at(first_x, first_y) || depth.row(first_y)[first_x] == none)
            return;
        island.assign(1, {first_x, first_y});
        seen.set(first_x, first_y);
        for (std::size_t i = 0; i < island.size(); ++i) {
            const Place at = island[i];
            for (const Place next : {Place{at.x - 1, at.y}, Place{at.x + 1, at.y},
                                     Place{at.x, at.y - 1}, Place{at.x, at.y + 1}}) {
                if (!seen.inside(next.x, next.y) || seen.at(next.x, next.y) ||
                    !hang_together(depth.row(at.y)[at.x], depth.row(next.y)[next.x],
                                   rule.tolerance))
                    continue;
                seen.set(next.x, next.y);
                island.push_back(next);
            }
        }
        if (int(island.size()) <= rule.max_pixels)
            for (const Place at : island)
                depth.row(at.y)[at.x] = none;
    });
}

void apply_kalman_reference(const DepthPlane& in, const KalmanRule& rule, int boost,
                            KalmanState& state) {
    for_each_pixel(in.size(), [&](int x, int y) {
        const KalmanPixel before{state.depth.row(y)[x], state.estimate.row(y)[x],
                                 state.gain.row(y)[x]};
        const KalmanPixel after = kalman_step(before, in.row(y)[x], rule, boost);
        state.depth.row(y)[x] = after.depth;
        state.estimate.row(y)[x] = after.estimate;
        state.gain.row(y)[x] = after.gain;
    });
}

void apply_steady_reference(const DepthPlane& in, const SteadyRule& rule, int missed,
                            SteadyState& state) {
    const Size size = in.size();
    for (int top = 0; top < size.height; top += steady_block)
        for (int left = 0; left < size.width; left += steady_block) {
            const int columns = smaller(steady_block, size.width - left);
            const int rows = smaller(steady_block, size.height - top);
            const bool moves =
                steady_block_moves(state.depth.row(top) + left, state.depth.pitch(),
                                   in.row(top) + left, in.pitch(), columns, rows, rule);
            for (int y = top; y < top + rows; ++y)
                for (int x = left; x < left + columns; ++x) {
                    const SteadyPixel before{state.depth.row(y)[x], state.run.row(y)[x]};
                    const SteadyPixel after =
                        steady_step(before, in.row(y)[x], rule, missed, moves);
                    state.depth.row(y)[x] = after.depth;
                    state.run.row(y)[x] = after.run;
                }
        }
}

}  // namespace theatron::filter
