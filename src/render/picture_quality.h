// SPDX-License-Identifier: Apache-2.0
// Figures for the difference of a drawn picture from the exact one: `theatron bench view`.
//
// Each figure is summed over pictures: call add() for each, then read the result. All
// views of one add() have the same size; a mask is not 0 at the pixels that count.
#pragma once

#include "image/image.h"

namespace theatron::render {

using MaskView = View<const std::uint8_t>;

// Mean squared difference of all three channels.
class SquaredError {
public:
    void add(ColorView drawn, ColorView exact, MaskView mask);
    double root_mean_square() const;  // in steps of 255; 0 without pixels
    double psnr_db() const;           // at most 99

private:
    double sum_ = 0, count_ = 0;
};

// Structural similarity of brightness in windows of 8x8 pixels (Wang et al. 2004), over windows
// that lie in the mask with at least half of their pixels. Other pixels count as equal.
class Similarity {
public:
    void add(ColorView drawn, ColorView exact, MaskView mask);
    double mean() const { return count_ > 0 ? sum_ / count_ : 1; }

private:
    double sum_ = 0, count_ = 0;
};

// Mean distance in pixels of an exact outline in the mask from the next drawn outline. An outline
// is where depth jumps back by more than `jump_mm`; 0 mm, nothing drawn, counts as infinitely far.
class OutlineError {
public:
    static constexpr int jump_mm = 150;
    static constexpr int reach = 8;  // further away counts as this far

    void add(DepthView drawn_mm, DepthView exact_mm, MaskView mask);
    double mean_px() const { return count_ > 0 ? sum_ / count_ : 0; }

private:
    double sum_ = 0, count_ = 0;
};

// The share of the mask without its surface: nothing is drawn, or something more than `jump_mm`
// behind. Pixels within two pixels of an exact outline do not count, because OutlineError
// measures them.
class Holes {
public:
    static constexpr int usual_jump_mm = 150;

    explicit Holes(int jump_mm = usual_jump_mm) : jump_mm_(jump_mm) {}
    void add(DepthView drawn_mm, DepthView exact_mm, MaskView mask);
    double percent() const { return count_ > 0 ? 100 * holes_ / count_ : 0; }
    double missing_pixels() const { return holes_; }

private:
    int jump_mm_;
    double holes_ = 0, count_ = 0;
};

}  // namespace theatron::render
