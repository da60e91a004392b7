// SPDX-License-Identifier: Apache-2.0
// Where the room's marks are drawn: on the live cloud, on parts of an organ as these are shown, and
// on a slice, on the screen and in the organ.
#pragma once

#include <vector>

#include "room/mark_scene.h"
#include "viewer/case_scene.h"

namespace theatron::viewer {

// The frame of the points of marks on a surface, and its scale.
struct MarkFrame {
    Pose room_from_points;
    double scale = 1;
};

// The frame for new marks on an organ, a part, or the screen; nullopt for other objects.
std::optional<MarkFrame> mark_frame(const CaseScene& scene, session::ObjectId object);

// A mark on a hidden part, or on a slice that is not shown, is drawn nowhere; one on a slice that
// also cuts the organ is drawn twice.
void append_placed(const session::Mark& mark, bool is_recorded, const CaseScene& scene,
                   std::vector<room::PlacedMark>& placed);
std::vector<room::PlacedMark> placed_marks(const session::RoomObjects& objects,
                                           const CaseScene& scene);

}  // namespace theatron::viewer
