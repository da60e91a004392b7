// SPDX-License-Identifier: Apache-2.0
// The inside of a room: a box that stands on the ground.
#pragma once

namespace theatron::furniture {

// Room coordinates in metres: x from left to right, z from back to front, y from 0 to the height.
struct Extent {
    double left = 0, right = 0, back = 0, front = 0;
    double height = 0;
    bool operator==(const Extent&) const = default;
};

}  // namespace theatron::furniture
