// SPDX-License-Identifier: Apache-2.0
// Fills small holes by iterated median-based morphology.
//
// The shape of the holes alone decides which pixels may be filled: the closing of the
// measured pixels by a square. They are filled from the rim inwards, one ring per iteration,
// with the median of their known neighbours. A hole that touches a depth edge is not filled,
// because the position of the edge inside the hole is unknown.
#pragma once

#include <vector>

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

struct HoleRule {
    int iterations = 4;  // rings; also the distance from an edge within which nothing is filled
    // A pixel stays empty if it lies in a square without measurements that is wider than
    // this. Pixels outside the image count as not measured. At most 31.
    int max_size = 8;
    int min_neighbours = 3;  // measured or filled, of eight
    Tolerance tolerance;     // neighbours that differ by more are an edge
};

// Working memory of fill_holes, for planes of one size.
class HoleScratch {
public:
    explicit HoleScratch(Size size);

    // One bit per pixel of a plane, including the margins on both sides and `margin_rows`
    // rows above and below. The rows form one array of words: bits shifted in from a
    // neighbouring row come from its margin, and are 0.
    static constexpr int margin_rows = 32;
    std::ptrdiff_t words_per_row() const { return words_per_row_; }
    static constexpr std::ptrdiff_t slack = 8;  // words, readable before and after
    using Bits = std::vector<std::uint64_t>;

    Bits hole;       // not measured, margins included
    Bits may_fill;   // allowed by the shape of the holes
    Bits open;       // of these, not yet processed
    Bits known;      // measured or filled
    Bits candidate;  // processed in the current iteration
    Bits edge;       // near an edge
    Bits work;

    // Eight adjacent pixels, one byte of bits, at least one of them set. The number is the
    // byte's index from row 0 of the image on; times eight, it is the index of the pixels.
    using Group = std::uint32_t;
    struct Groups {
        std::vector<Group> places;
        std::size_t count = 0;
    };
    Groups all, some;                  // all fillable; those of the current iteration
    std::vector<std::uint16_t> depth;  // new values of the groups' pixels, and
    std::vector<std::uint8_t> filled;  // a bit per pixel that gets one

private:
    std::ptrdiff_t words_per_row_;
};

// Fills holes of `depth` in place. The reference defines the filter.
void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& scratch);
void fill_holes_reference(DepthPlane& depth, const HoleRule& rule);

// The neighbourhood of a pixel in a hole; `pixel` points into an image with a margin of one.
struct HoleRim {
    int count = 0;   // neighbours that are measured or filled
    int median = 0;  // of these; the lower one for an even count
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
