// SPDX-License-Identifier: Apache-2.0
#include "viewer/marking.h"

#include <utility>

#include "viewer/mark_actions.h"
#include "viewer/placed_marks.h"

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

std::optional<SurfacePoint> surface_at(Vec2 pointer, const render::CameraView& view,
                                       Meeting& meeting, const std::vector<CloudCamera>& cloud) {
    const render::PickRay ray = render::ray_through(view, pointer);
    const auto hit = meeting.pick(ray, view);
    const auto measured = pick_cloud(cloud, ray);
    if (measured && (!hit || measured->distance_m < length(hit->picked.place - ray.from)))
        return SurfacePoint{
            MarkedSurface::cloud, {}, measured->place, measured->normal, measured->measured};
    const auto& open = meeting.case_scene().in_room();
    if (!hit || !open)
        return std::nullopt;
    const bool is_screen = open->screen && hit->object == open->screen->id;
    if (is_screen && !meeting.case_scene().monitor().patient_point(*open, hit->picked.place))
        return std::nullopt;
    if (!is_screen && !open->find(hit->object))
        return std::nullopt;
    return SurfacePoint{is_screen ? MarkedSurface::slice : MarkedSurface::organ, hit->object,
                        hit->picked.place, hit->picked.normal, std::nullopt};
}

void Marking::choose(std::optional<MarkKind> tool, Meeting& meeting) {
    tool_ = tool;
    draft_.reset();
    meeting.set_new_mark(std::nullopt);
}

bool Marking::begin(const SurfacePoint& at, const Meeting& meeting) {
    const auto point = point_at(at, meeting);
    if (!point)
        return false;
    Draft draft{at, at, {}};
    draft.mark.kind = *tool_;
    draft.mark.surface = at.surface;
    draft.mark.object = std::uint32_t(at.object);
    draft.mark.number = *tool_ == MarkKind::pin ? 1 : 0;
    draft.mark.points.assign(*tool_ == MarkKind::pin ? 1 : 2, *point);
    if (!sign_mark(meeting.room(), draft.mark))
        return false;
    draft_ = std::move(draft);
    return true;
}

void Marking::go_on(const SurfacePoint& at, const Meeting& meeting) {
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

bool Marking::is_worth_keeping() const {
    const Mark& mark = draft_->mark;
    if (mark.kind == MarkKind::pin)
        return true;
    if (mark.kind == MarkKind::stroke)
        return mark.points.size() > 2;
    return length(mark.points[1].position - mark.points[0].position) >= least_length_m;
}

bool Marking::on_input(xr::WindowInput& input, const render::CameraView& view, Meeting& meeting,
                       const std::vector<CloudCamera>& cloud, client::Participant& participant) {
    if (!tool_)
        return false;
    if (input.grabbed && input.grabbed_left && !draft_)
        if (const auto at = surface_at(*input.grabbed, view, meeting, cloud);
            at && begin(*at, meeting))
            input.grabbed.reset();
    if (!draft_)
        return false;
    input.steering.turn = {};
    if (input.pointer)
        if (const auto at = surface_at(*input.pointer, view, meeting, cloud))
            go_on(*at, meeting);
    if (!input.released) {
        // As the host will have it: shorter, with the same ends.
        Mark preview = draft_->mark;
        simplify_stroke(preview);
        meeting.set_new_mark(std::move(preview));
        return true;
    }
    if (is_worth_keeping())
        (void)make_mark(participant, draft_->mark);
    draft_.reset();
    meeting.set_new_mark(std::nullopt);
    return true;
}

}  // namespace theatron::viewer
