// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/mark.h"

#include <utility>

#include "viewer/placed_marks.h"
#include "viewer/tools/mark_actions.h"

namespace theatron::viewer {
namespace {

using session::Mark;
using session::MarkedSurface;
using session::MarkKind;
using session::MarkPoint;

// Points of a stroke are so far apart, in the frame of its surface.
constexpr double least_step_m = 0.001;
constexpr std::size_t most_drawn_points = 4000;
// A shorter arrow or distance is a click.
constexpr double least_length_m = 0.002;

MarkPoint in_frame(const MarkFrame& frame, Vec3 place, Vec3 normal) {
    return {(inverse(frame.room_from_points) * place) * (1 / frame.scale),
            rotate(conjugate(frame.room_from_points.rotation), normal)};
}

std::optional<MarkPoint> point_at(const SurfacePoint& at, const Meeting& meeting) {
    if (at.surface == MarkedSurface::cloud)
        return MarkPoint{at.place, at.normal};
    const auto frame = mark_frame(meeting.case_scene(), at.object);
    return frame ? std::optional(in_frame(*frame, at.place, at.normal)) : std::nullopt;
}

}  // namespace

void MarkTool::end(Meeting& meeting) {
    draft_.reset();
    meeting.set_new_mark(std::nullopt);
}

void MarkTool::begin(const SurfacePoint& at, const Meeting& meeting) {
    const auto point = point_at(at, meeting);
    if (!point)
        return;
    Draft draft{at, at, {}};
    draft.mark.kind = kind_;
    draft.mark.surface = at.surface;
    draft.mark.object = std::uint32_t(at.object);
    draft.mark.number = kind_ == MarkKind::pin ? 1 : 0;
    draft.mark.points.assign(kind_ == MarkKind::pin ? 1 : 2, *point);
    if (!sign_mark(meeting.room(), draft.mark))
        return;
    draft_ = std::move(draft);
}

void MarkTool::go_on(const SurfacePoint& at, const Meeting& meeting) {
    Mark& mark = draft_->mark;
    // Two parts of an organ: both ends are in the organ's frame, as if the parts were in place.
    const bool two_parts = mark.surface == MarkedSurface::organ &&
                           at.surface == MarkedSurface::organ && at.object != draft_->first.object;
    const bool is_one_line = mark.kind == MarkKind::arrow || mark.kind == MarkKind::distance;
    if (at.surface != mark.surface || (two_parts && !is_one_line))
        return;
    const auto point = point_at(at, meeting);
    if (!point)
        return;
    if (mark.kind != MarkKind::stroke) {
        mark.points.back() = *point;
        if (mark.kind != MarkKind::pin)
            mark.object = std::uint32_t(two_parts ? meeting.case_scene().in_room()->organ_id
                                                  : draft_->first.object);
    } else if (length(mark.points.back().position - point->position) >= least_step_m &&
               mark.points.size() < most_drawn_points) {
        mark.points.push_back(*point);
    }
    draft_->last = at;
    if (mark.kind == MarkKind::distance && draft_->first.measured && at.measured)
        mark.deviation_m =
            float(distance_between(*draft_->first.measured, *at.measured).deviation_m);
}

bool MarkTool::is_worth_keeping() const {
    const Mark& mark = draft_->mark;
    if (mark.kind == MarkKind::pin)
        return true;
    if (mark.kind == MarkKind::stroke)
        return mark.points.size() > 2;
    return length(mark.points[1].position - mark.points[0].position) >= least_length_m;
}

bool MarkTool::on_pointer(const Pointer& pointer, const ToolScene& scene) {
    if (pointer.presses || draft_)
        if (const auto at = pointer.ray
                                ? surface_at(*pointer.ray, scene.view, scene.meeting, scene.cloud)
                                : std::nullopt) {
            if (draft_)
                go_on(*at, scene.meeting);
            else
                begin(*at, scene.meeting);
        }
    if (!draft_)
        return false;
    if (!pointer.releases) {
        // As the host will have it: shorter, with the same ends.
        Mark preview = draft_->mark;
        simplify_stroke(preview);
        scene.meeting.set_new_mark(std::move(preview));
        return true;
    }
    if (is_worth_keeping())
        (void)make_mark(scene.participant, draft_->mark);
    end(scene.meeting);
    return true;
}

}  // namespace theatron::viewer
