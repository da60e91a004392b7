// SPDX-License-Identifier: Apache-2.0
// Marks and pointers over the plain picture of a camera, as lines and labels for a 2D canvas. They
// look as in the room (render/scene_lines.h), but what is before them does not hide them.
//
// Pure. Places are those of FlatPicture.
#pragma once

#include <string>
#include <vector>

#include "base/ids.h"
#include "render/scene_lines.h"
#include "session/mark.h"
#include "viewer/flat/flat_picture.h"

namespace theatron::viewer {

// As render::LinePiece; the radii are shares of the picture's height.
struct FlatPiece {
    Vec2 from, to;
    double from_radius = 0, to_radius = 0;
    double from_half_widths = 1, to_half_widths = 1;
};

struct FlatLine {
    std::vector<FlatPiece> pieces;
    Rgb color;
    bool points = false;  // the end of a pointer: before everything else
};

struct FlatLabel {
    std::string utf8;
    std::string brief;  // the same for a small picture
    Vec2 place;
    Rgb color;  // of the plate's edge
    render::LabelRank rank = render::LabelRank::name;
};

struct FlatDrawing {
    std::vector<FlatLine> lines;
    std::vector<FlatLabel> labels;
};

// Marks on organs and slices, which the picture does not show, are left out.
void add_mark(const session::Mark& mark, const FlatPicture& picture, FlatDrawing& drawing);
// The end of the ray of a person who points. `name` may be empty.
void add_pointer(ParticipantId person, const std::string& name, Vec3 place,
                 const FlatPicture& picture, FlatDrawing& drawing);

}  // namespace theatron::viewer
