// SPDX-License-Identifier: Apache-2.0
#include "viewer/placed_marks.h"

#include <algorithm>
#include <cmath>

namespace theatron::viewer {
namespace {

using session::Mark;
using session::MarkedSurface;

MarkFrame organ_frame(const session::CaseInRoom& room) {
    return {room.organ_object.room_from_object, room.organ_object.scale};
}

bool is_on(const Mark& mark, const Monitor::SliceFrame& slice) {
    return std::all_of(mark.points.begin(), mark.points.end(), [&](const session::MarkPoint& p) {
        return std::abs((slice.picture_from_organ * p.position).z) <= slice.half_step_m;
    });
}

}  // namespace

std::optional<MarkFrame> mark_frame(const CaseScene& scene, session::ObjectId object) {
    const auto& room = scene.in_room();
    if (!room)
        return std::nullopt;
    if (object == room->organ_id)
        return organ_frame(*room);
    if (room->screen && object == room->screen->id) {
        const auto slice = scene.slice_frame();
        return slice && slice->on_screen
                   ? std::optional(MarkFrame{slice->screen_from_organ, slice->screen_scale})
                   : std::nullopt;
    }
    const auto shown = scene.shown_pose(object);
    return shown ? std::optional(MarkFrame{*shown, room->organ_object.scale}) : std::nullopt;
}

void append_placed(const Mark& mark, bool is_recorded, const CaseScene& scene,
                   std::vector<room::PlacedMark>& placed) {
    if (mark.surface == MarkedSurface::cloud) {
        placed.push_back({mark, {}, 1, {}});
        return;
    }
    const auto& room = scene.in_room();
    const session::ObjectId object{is_recorded ? mark.object | session::recorded_bit : mark.object};
    if (!room)
        return;
    const auto frame = mark_frame(scene, object);
    if (mark.surface == MarkedSurface::organ) {
        if (!frame)
            return;
        const session::CaseInRoom::Part* part = room->find(object);
        if (part && !scene.has_place(*part))
            return;
        placed.push_back({mark, frame->room_from_points, frame->scale, scene.cut()});
        return;
    }
    const auto slice = scene.slice_frame();
    if (!slice || !room->screen || object != room->screen->id || !is_on(mark, *slice))
        return;
    if (frame)
        placed.push_back({mark, frame->room_from_points, frame->scale, {}});
    if (room->organ.cut)
        placed.push_back({mark, organ_frame(*room).room_from_points, organ_frame(*room).scale, {}});
}

std::vector<room::PlacedMark> placed_marks(const session::RoomObjects& objects,
                                           const CaseScene& scene) {
    std::vector<room::PlacedMark> placed;
    for (const auto& [id, object] : objects)
        if (object.kind == session::ObjectKind::mark)
            if (const auto mark = session::decode_mark(object.properties))
                append_placed(*mark, session::is_recorded(id), scene, placed);
    return placed;
}

}  // namespace theatron::viewer
