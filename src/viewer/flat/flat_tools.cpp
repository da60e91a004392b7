// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_tools.h"

#include "viewer/pointing_hand.h"

namespace theatron::viewer {
namespace {

std::optional<MarkedPlace> place_at(const FlatPicture* picture, Vec2 pointer) {
    const auto ray = picture ? picture->ray_through(pointer) : std::nullopt;
    const auto point = ray ? picture->surface_at(*ray) : std::nullopt;
    if (!point)
        return std::nullopt;
    return MarkedPlace{
        session::MarkedSurface::cloud, {}, {}, {point->place, point->normal}, point->measured};
}

Phrase why_nothing(const FlatPicture* picture, bool measures) {
    return !measures                             ? Phrase::camera_without_depth
           : !picture || !picture->has_surface() ? Phrase::depth_is_awaited
                                                 : Phrase::begin_on_surface;
}

}  // namespace

void FlatTools::choose(ToolKind kind) {
    const auto mark = marks_of(kind);
    chosen_ = mark ? kind : ToolKind::none;
    draft_.reset();
    if (mark)
        draft_.emplace(*mark);
}

void FlatTools::on_input(const window::WindowInput& input, const FlatPicture* picture,
                         bool measures) {
    point(input, picture, measures);
    if (draft_)
        draw(input, picture, measures);
}

bool FlatTools::give_up() {
    if (!drawn())
        return false;
    draft_->drop();
    return true;
}

void FlatTools::lift() {
    if (!draft_)
        return;
    if (auto mark = draft_->release())
        made_.push_back(std::move(*mark));
    if (chosen_ == ToolKind::stroke)
        draft_->drop();
}

void FlatTools::point(const window::WindowInput& input, const FlatPicture* picture, bool measures) {
    const bool begins = input.points && !points_;
    points_ = input.points;
    pointing_.reset();
    pointed_.reset();
    if (!points_)
        return;
    const bool can_meet = picture && picture->has_surface();
    if (begins && !can_meet)
        advice_ = why_nothing(picture, measures);
    if (!picture || !input.pointer)
        return;
    const render::PickRay none{picture->eye(), {}};
    pointed_ = pointed_place([&](Vec2 at) { return picture->ray_through(at).value_or(none); },
                             picture->aspect(), *input.pointer,
                             [&](const render::PickRay& ray) -> std::optional<Vec3> {
                                 const auto point = ray.direction == none.direction
                                                        ? std::nullopt
                                                        : picture->surface_at(ray);
                                 return point ? std::optional(point->place) : std::nullopt;
                             });
    if (pointed_)
        pointing_ = ray_along(picture->eye(), *pointed_);
    else if (can_meet && !misses_)
        advice_ = Phrase::points_at_nothing;
    misses_ = !pointed_ && can_meet;
}

void FlatTools::draw(const window::WindowInput& input, const FlatPicture* picture, bool measures) {
    if (input.grabbed && input.grabbed_left) {
        pointer_ = *input.grabbed;
        if (!draft_->press(place_at(picture, pointer_)))
            advice_ = why_nothing(picture, measures);
    }
    // A pointer that rests draws nothing, although a live surface moves below it.
    if (input.pointer && draft_->is_open() && *input.pointer != pointer_) {
        pointer_ = *input.pointer;
        if (const auto place = place_at(picture, pointer_))
            draft_->move_to(*place);
    }
    if (input.released)
        if (auto mark = draft_->release())
            made_.push_back(std::move(*mark));
    if (const auto next = draft_->take_advice())
        advice_ = next;
}

}  // namespace theatron::viewer
