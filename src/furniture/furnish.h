// SPDX-License-Identifier: Apache-2.0
// The furniture of a room: which pieces stand where.
//
// Pure functions, in metres of the room. The operating table stands over the room's origin, as the
// real one does (docs/room.md); other pieces stand at the walls. A piece gives way, that is, it is
// left out, where a camera of the room sees its place, and where it has no space.
#pragma once

#include <string_view>
#include <vector>

#include "furniture/extent.h"
#include "furniture/model.h"
#include "geometry/calibration.h"

namespace theatron::furniture {

struct Piece {
    std::string_view name;
    Pose room_from_piece;
    Box box;            // in the room, around all of it
    bool blocks;        // people do not go through it: it stands or hangs where they move
    bool casts_shadow;  // in the shadow map of high quality: not what hangs under the ceiling's
                        // light
    Model model;        // in its own frame
};

// Boxes in the room around slices of a piece, 0.2 m thick at most, along its longer side: a table
// with arm boards leaves the corners beside them free.
std::vector<Box> obstacles_of(const Piece& piece);

// True if a camera at this place sees a part of the box nearer than 4.5 m: of 27 points of it, at
// least one is in the picture of its depth lens. A camera that is not registered sees nothing.
// Surfaces in front of the box count for nothing: what the camera has not measured yet, it may
// measure in the next picture.
bool is_seen(const Box& box, const Calibration& camera);

// The pieces of a room of this size, without those that a camera sees.
std::vector<Piece> furnish(const Extent& extent, const std::vector<Calibration>& cameras);

}  // namespace theatron::furniture
