// SPDX-License-Identifier: Apache-2.0
// Lines and labels that are seen and read in every picture: marks, pointers and their texts.
//
// A line has a least width in pixels, however far away it is, and an outline that stands out from
// any ground. A label is upright in the picture and on a plate; that of a number is before
// everything else, and whole. No GL type appears here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::render {

// A straight piece of a line with round ends; of length 0: a disc. Metres; each end has its radius
// in metres, or in the line's least half widths where that is more. An end with neither is the tip
// of an arrow's head, whose base is flat, and which is at least as long in the picture as it is
// wide.
struct LinePiece {
    Vec3 from, to;
    double from_radius_m = 0, to_radius_m = 0;
    double from_half_widths = 1, to_half_widths = 1;
};

// The pieces of a line on the GPU. Needs the GL context current in which it was made.
class SceneLineMesh {
public:
    explicit SceneLineMesh(const std::vector<LinePiece>& pieces);
    ~SceneLineMesh();
    SceneLineMesh(SceneLineMesh&&) noexcept;
    SceneLineMesh& operator=(SceneLineMesh&&) noexcept;

    struct Buffers;
    const Buffers& buffers() const { return *buffers_; }

private:
    std::unique_ptr<Buffers> buffers_;
};

// The least width of a line in a picture of this size, and the width of its outline at each side:
// pixels. At least 4 and 1.5; more in large pictures, which are seen on large screens.
double least_line_width(Size picture);
double outline_width(Size picture);
// The colour of an outline: dark around bright colours, bright around dark ones.
Rgb outline_color(Rgb line);

// Labels of a lower rank make room: one of rank `author` is left out where it covered another.
enum class LabelRank { author, name, number };

struct SceneLabel {
    std::string utf8;
    Vec3 place;  // in the room; it stands beside it, and is left out where the picture lacks it
    Rgb color;   // of the plate's edge
    LabelRank rank = LabelRank::name;
};

// The height of a label's capital letters in a picture of this size: pixels, at least 11.
double label_height(Size picture);

}  // namespace theatron::render
