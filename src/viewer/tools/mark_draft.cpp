// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/mark_draft.h"

namespace theatron::viewer {

using session::Mark;
using session::MarkedSurface;
using session::MarkKind;

namespace {

// Points of a stroke are so far apart, in the frame of its surface.
constexpr double least_step_m = 0.001;
constexpr std::size_t most_drawn_points = 4000;
// A shorter arrow or distance is a click.
constexpr double least_length_m = 0.002;

}  // namespace

bool MarkDraft::has_two_ends() const {
    return kind_ == MarkKind::arrow || kind_ == MarkKind::distance;
}

bool MarkDraft::press(const std::optional<MarkedPlace>& place) {
    if (!place) {
        drop();
        return false;
    }
    is_pressed_ = true;
    if (is_open()) {
        move_to(*place);
        return true;
    }
    first_ = *place;
    Mark& mark = mark_.emplace();
    mark.kind = kind_;
    mark.surface = place->surface;
    mark.object = std::uint32_t(place->object);
    mark.number = kind_ == MarkKind::pin ? 1 : 0;
    mark.points.assign(kind_ == MarkKind::pin ? 1 : 2, place->point);
    return true;
}

void MarkDraft::move_to(const MarkedPlace& place) {
    // Two parts of an organ: both ends are in the organ's frame, as if the parts were in place.
    const bool two_parts = place.surface == MarkedSurface::organ && place.object != first_.object;
    if (!is_open() || place.surface != first_.surface || (two_parts && !has_two_ends()))
        return;
    if (kind_ == MarkKind::stroke) {
        auto& points = mark_->points;
        if (length(points.back().position - place.point.position) >= least_step_m &&
            points.size() < most_drawn_points)
            points.push_back(place.point);
        return;
    }
    mark_->points.back() = place.point;
    if (has_two_ends())
        mark_->object = std::uint32_t(two_parts ? place.organ : first_.object);
    if (kind_ == MarkKind::distance && first_.measured && place.measured)
        mark_->deviation_m = float(distance_between(*first_.measured, *place.measured).deviation_m);
}

bool MarkDraft::is_complete() const {
    const auto& points = mark_->points;
    if (kind_ == MarkKind::pin)
        return true;
    if (kind_ == MarkKind::stroke)
        return points.size() > 2;
    return length(points[1].position - points[0].position) >= least_length_m;
}

std::optional<Mark> MarkDraft::release() {
    if (!is_pressed())
        return std::nullopt;
    is_pressed_ = false;
    if (is_complete())
        return std::exchange(mark_, std::nullopt);
    advice_ = has_two_ends() ? Phrase::press_at_other_end : Phrase::draw_by_dragging;
    if (!has_two_ends())
        drop();
    return std::nullopt;
}

}  // namespace theatron::viewer
