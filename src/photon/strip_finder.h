// SPDX-License-Identifier: Apache-2.0
// Finds strips in pictures: of any size from 48 pixels of width, turned, seen at a slant.
#pragma once

#include <vector>

#include "photon/strip_reader.h"

namespace theatron::photon {

// All strips of a picture from 48 x 16 pixels to max_side a side, in the order of their left ends.
// Smaller pictures have none. Safe for any pixels.
std::vector<StripReading> find_strips(GreyView grey);

// Finds strips in the pictures of a film: first where they were in the picture before, which costs
// little, and in the whole picture where that is not enough.
class StripFinder {
public:
    // Fewer strips than `expected` are looked for in the whole of each picture.
    explicit StripFinder(std::size_t expected = 2) : expected_(expected) {}

    std::vector<StripReading> find(GreyView grey);

private:
    struct Known {
        Quad frame;
        int missed = 0;  // pictures in a row that did not show it
    };
    const std::size_t expected_;
    std::vector<Known> known_;
    int since_search_ = 0;  // pictures
};

}  // namespace theatron::photon
