// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_drawing.h"

#include <algorithm>
#include <utility>

#include "room/mark_shape.h"
#include "room/people.h"
#include "room/pointers.h"
#include "room/srgb.h"

namespace theatron::viewer {
namespace {

void add_pieces(const std::vector<render::LinePiece>& pieces, Rgb color, const FlatPicture& picture,
                FlatDrawing& drawing) {
    FlatLine line{{}, color};
    for (const render::LinePiece& piece : pieces) {
        const auto from = picture.seen_at(piece.from), to = picture.seen_at(piece.to);
        if (from && to)
            line.pieces.push_back({from->place, to->place,
                                   piece.from_radius_m * from->heights_per_m,
                                   piece.to_radius_m * to->heights_per_m, piece.from_half_widths,
                                   piece.to_half_widths});
    }
    if (!line.pieces.empty())
        drawing.lines.push_back(std::move(line));
}

bool is_inside(Vec2 place) {
    return place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1;
}

void add_label(const std::string& text, const std::string& brief, const std::vector<Vec3>& places,
               Rgb color, render::LabelRank rank, const FlatPicture& picture,
               FlatDrawing& drawing) {
    if (text.empty())
        return;
    for (const Vec3 place : places)
        if (const auto seen = picture.seen_at(place); seen && is_inside(seen->place))
            return drawing.labels.push_back({text, brief, seen->place, color, rank});
}

}  // namespace

void add_mark(const session::Mark& mark, const FlatPicture& picture, FlatDrawing& drawing) {
    if (mark.surface != session::MarkedSurface::cloud)
        return;
    const Rgb color = room::srgb_of(room::color_of(ParticipantId{mark.color}));
    add_pieces(room::mark_line(mark), color, picture, drawing);
    add_label(room::label_of(mark), room::short_label_of(mark), room::label_places(mark), color,
              room::rank_of(mark.kind), picture, drawing);
}

void add_pointer(ParticipantId person, const std::string& name, Vec3 place,
                 const FlatPicture& picture, FlatDrawing& drawing) {
    const Rgb color = room::srgb_of(room::color_of(person));
    const std::size_t before = drawing.lines.size();
    add_pieces({room::pointer_end(place)}, color, picture, drawing);
    if (drawing.lines.size() > before)
        drawing.lines.back().points = true;
    add_label(name, name, {place}, color, render::LabelRank::name, picture, drawing);
}

}  // namespace theatron::viewer
