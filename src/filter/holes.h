// SPDX-License-Identifier: Apache-2.0
// Fills small holes by iterated median-based morphology.
//
// Which pixels may be filled follows from the shape of the holes alone: the
// closing of the measured pixels by a square. They are filled from the rim
// inwards, a ring an iteration, with the median of what is there. A hole that
// touches a depth edge stays as it is, for nobody knows where in it the edge runs.
#pragma once

#include <vector>

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

struct HoleRule {
    int iterations = 4;  // rings; also how far from an edge nothing is filled
    // A pixel is left if it lies in a square without measurements that is wider
    // than this. What lies outside the image is not measured. At most 31.
    int max_size = 8;
    int min_neighbours = 3;  // measured or filled, of eight
    Tolerance tolerance;     // neighbours further apart than this are an edge
};

// What fill_holes needs while it runs, for planes of one size.
class HoleScratch {
public:
    explicit HoleScratch(Size size);

    // A bit per pixel of a plane, margins at both sides included, and of `margin_rows`
    // above and below. The whole is one array of words: what a shift brings in from
    // the row before or after comes from a margin.
    static constexpr int margin_rows = 32;
    std::ptrdiff_t words_per_row() const { return words_per_row_; }
    static constexpr std::ptrdiff_t slack = 8;  // words, readable before and after
    using Bits = std::vector<std::uint64_t>;

    Bits hole;       // not measured; the margins too
    Bits may_fill;   // by the shape of the holes
    Bits open;       // of these, not yet looked at
    Bits known;      // measured or filled
    Bits candidate;  // what an iteration looks at
    Bits edge;       // what is near an edge
    Bits work;

    // Eight pixels side by side, a byte of bits, in which a bit is set: the byte's
    // place from the row of the image's first pixel on. The pixels' is eight times that.
    using Group = std::uint32_t;
    struct Groups {
        std::vector<Group> places;
        std::size_t count = 0;
    };
    Groups all, some;                  // all that may be filled; what one iteration looks at
    std::vector<std::uint16_t> depth;  // of some groups: what they may be filled with, and
    std::vector<std::uint8_t> filled;  // where

private:
    std::ptrdiff_t words_per_row_;
};

// Fills holes of `depth` in place. The reference defines the filter.
void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& scratch);
void fill_holes_reference(DepthPlane& depth, const HoleRule& rule);

// What a hole's pixel sees around it; `pixel` points into an image with a margin
// of one.
struct HoleRim {
    int count = 0;   // measured or filled neighbours
    int median = 0;  // the lower one of an even number
    bool edge = false;
};

THEATRON_HD inline HoleRim rim_of(const std::uint16_t* pixel, std::ptrdiff_t pitch,
                                  Tolerance tolerance) {
    int sorted[8];
    HoleRim rim;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int depth = pixel[dy * pitch + dx];
            if ((dx == 0 && dy == 0) || depth == none)
                continue;
            int at = rim.count++;
            for (; at > 0 && sorted[at - 1] > depth; --at)
                sorted[at] = sorted[at - 1];
            sorted[at] = depth;
        }
    if (rim.count == 0)
        return rim;
    rim.median = sorted[(rim.count - 1) / 2];
    rim.edge = sorted[rim.count - 1] - sorted[0] > tolerance_at(tolerance, sorted[0]);
    return rim;
}

}  // namespace theatron::filter
