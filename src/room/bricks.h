// SPDX-License-Identifier: Apache-2.0
// Interlocking bricks, which people handle together if no medical case is loaded, and which the
// paper's studies used. A brick that is released close to another one snaps onto its studs.
#pragma once

#include <optional>
#include <vector>

#include "base/bytes.h"
#include "geometry/vec.h"
#include "render/scene_frame.h"

namespace theatron::room {

// In its own frame the bottom of a brick is in y = 0, centred at the origin; studs are on top.
inline constexpr double stud_pitch_m = 0.04, brick_height_m = 0.048;
inline constexpr int most_studs = 8;  // along one side

struct Brick {
    int studs_x = 4, studs_z = 2;
    std::uint8_t color = 0;  // drawn as room::color_of(ParticipantId{color})
    bool operator==(const Brick&) const = default;
};

// The properties of an object of kind brick (docs/formats/room.md). decode_brick() is safe for
// untrusted input: nullopt for bytes that are no brick.
Bytes encode_brick(const Brick& brick);
std::optional<Brick> decode_brick(ByteView properties);

struct PlacedBrick {
    Brick brick;
    Pose room_from_brick;
};

// The pose of a brick that is released at `released`: on or under the nearest fitting studs of
// `others` if its corners are within 2.5 cm of that pose and it is turned by less than 20 degrees
// from it, otherwise `released`. All scales are 1.
Pose snapped(const Brick& brick, const Pose& released, const std::vector<PlacedBrick>& others);

render::MeshData make_brick_mesh(const Brick& brick);

}  // namespace theatron::room
