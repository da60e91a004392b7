// SPDX-License-Identifier: Apache-2.0
// The order in which Strata codes pixels, and the memory layout that follows from it.
//
// 32 rows (a group) are coded at once, one row per vector lane. Row k runs 4 pixels
// behind row k - 1, so that the pixels coded in one step form a diagonal:
//
//     number: step in which the pixel is coded; [9]: being coded; . : not yet coded
//
//     position        0   1   2   3   4   5   6   7   8   9
//     row 0, lane 0   0   1   2   3   4   5   6   7   8  [9]
//     row 1, lane 1   4   5   6   7   8  [9]  .   .   .   .
//     row 2, lane 2   8  [9]  .   .   .   .   .   .   .   .
//
// All neighbours that predict pixel X were coded at least one step earlier, in
// every lane, so that one vector instruction serves all rows of a group:
//
//                 NN            -8              steps relative to X, always the same:
//             NW  N  NE  NEE    -5 -4 -3 -2     a row up is 4 steps and one lane back,
//         WW  W   X          -2 -1  0           a pixel to the left is 1 step back
//
// A lane that ends its row continues without a pause with the row 32 below, which
// is the same lane of the next group. A row has `pitch` positions: two in front of
// the image, its pixels, and at least two behind. Lane 0 reads the rows of lanes 30
// and 31 of the group before, `delay` steps later than a lane 32 would.
//
// All arrays are therefore indexed by step and lane instead of row and column. A
// plane has 40 values per step: 4 in front, the 32 lanes, 4 behind. The values in
// front are copies of lanes 28 to 31 of the group above. The first one behind is a
// copy of lane 0 of the group below, which is only read in a reference frame. A
// separate 64-bit mask per step has one bit per value of the plane: 1 = measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "image/view.h"

namespace theatron::codec::strata {

inline constexpr int lane_count = 32;
inline constexpr int skew = 4;       // steps by which a row is behind the one above
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

    // Steps by which lane 0 of a group is later than a lane 32 of the group before
    // would be. Values of that group are copied over this distance.
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
