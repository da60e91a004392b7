// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/mark.h"

#include "viewer/placed_marks.h"
#include "viewer/tools/mark_actions.h"

namespace theatron::viewer {
namespace {

using session::MarkedSurface;
using session::MarkPoint;

MarkPoint in_frame(const MarkFrame& frame, Vec3 place, Vec3 normal) {
    return {(inverse(frame.room_from_points) * place) * (1 / frame.scale),
            rotate(conjugate(frame.room_from_points.rotation), normal)};
}

std::optional<MarkedPlace> place_at(const render::PickRay& ray, const ToolScene& scene) {
    const auto at = surface_at(ray, scene.view, scene.meeting, scene.cloud);
    if (!at)
        return std::nullopt;
    if (at->surface == MarkedSurface::cloud)
        return MarkedPlace{at->surface, {}, {}, {at->place, at->normal}, at->measured};
    const CaseScene& shown = scene.meeting.case_scene();
    const auto frame = mark_frame(shown, at->object);
    if (!frame)
        return std::nullopt;
    return MarkedPlace{at->surface, at->object, shown.in_room()->organ_id,
                       in_frame(*frame, at->place, at->normal), std::nullopt};
}

bool is_same(const render::PickRay& a, const render::PickRay& b) {
    return a.from == b.from && a.direction == b.direction;
}

}  // namespace

void MarkTool::end(Meeting& meeting) {
    draft_.drop();
    meeting.set_new_mark(std::nullopt);
}

bool MarkTool::on_pointer(const Pointer& pointer, const ToolScene& scene) {
    if (pointer.presses) {
        if (!draft_.press(pointer.ray ? place_at(*pointer.ray, scene) : std::nullopt)) {
            end(scene.meeting);
            return false;
        }
        ray_ = *pointer.ray;
    }
    if (!draft_.is_open())
        return false;
    // A pointer that rests draws nothing, although a live surface moves below it.
    if (pointer.ray && !is_same(*pointer.ray, ray_)) {
        ray_ = *pointer.ray;
        if (const auto place = place_at(ray_, scene))
            draft_.move_to(*place);
    }
    const bool is_used = draft_.is_pressed();
    if (pointer.releases)
        if (auto mark = draft_.release())
            (void)make_mark(scene.participant, std::move(*mark));
    scene.meeting.set_new_mark(
        draft_.is_open() ? preview_of(scene.participant.room(), draft_.mark()) : std::nullopt);
    return is_used;
}

}  // namespace theatron::viewer
