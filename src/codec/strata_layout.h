// SPDX-License-Identifier: Apache-2.0
// Where Strata keeps the pixels of an image while it codes them.
//
// Strata works on 32 rows at once, a wavefront: at step t, lane k is at position
// t - 4k of its row, so that the pixels left, above and right above of all lanes
// are known from earlier steps. When a lane ends its row it goes on with the row
// 32 below, without a pause. A row has `pitch` positions: two in front of the
// image, its pixels, and at least two behind.
//
// Everything is therefore stored by step and lane. A "plane" keeps 40 values a
// step: the lanes from value 4 on, in front of them copies of the two lanes above
// the first one (rows of the 32 before), behind them one of the lane below. Which of
// them were measured stands beside it, a bit for each in a number per step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "image/view.h"

namespace theatron::codec::strata {

inline constexpr int lane_count = 32;
inline constexpr int skew = 4;       // steps that a row lags behind the one above
inline constexpr int row_front = 2;  // positions in front of a row
inline constexpr int least_delay = 8;
inline constexpr int plane_stride = 40;
inline constexpr int plane_origin = 4;
inline constexpr int plane_margin = 8;  // steps of zeros before the first and after the last

struct Layout {
    Size size;
    int pitch = 0;
    int groups = 0;
    int steps = 0;

    // Steps from the time a lane does a position to the time when the lane of
    // the same number + 32 would do it.
    int delay() const { return pitch - lane_count * skew; }
    std::size_t coded_values() const { return std::size_t(steps) * lane_count; }
    std::size_t plane_steps() const { return std::size_t(steps + 2 * plane_margin); }
    std::size_t plane_values() const { return plane_steps() * plane_stride; }
    int step_of(int x, int y) const {
        return y / lane_count * pitch + x + row_front + skew * (y % lane_count);
    }
};

inline Layout layout_of(Size size) {
    Layout layout;
    layout.size = size;
    layout.pitch = std::max(row_front + size.width + 2, lane_count * skew + least_delay);
    layout.groups = (size.height + lane_count - 1) / lane_count;
    layout.steps = layout.groups * layout.pitch + skew * (lane_count - 1);
    return layout;
}

}  // namespace theatron::codec::strata
