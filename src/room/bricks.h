// SPDX-License-Identifier: Apache-2.0
// Interlocking bricks: what people handle together where no medical case is loaded, and what the
// paper's studies used. A brick that is released close to another one snaps onto its studs.
#pragma once

#include <optional>
#include <vector>

#include "base/bytes.h"
#include "geometry/vec.h"
#include "render/scene_frame.h"

namespace theatron::room {

// In its own frame a brick stands on y = 0, its middle at the origin; studs are on top.
inline constexpr double stud_pitch_m = 0.04, brick_height_m = 0.048;
inline constexpr int most_studs = 8;  // along one side

struct Brick {
    int studs_x = 4, studs_z = 2;
    std::uint8_t color = 0;  // as room::color_of gives one
    bool operator==(const Brick&) const = default;
};

// The properties of an object of kind brick (docs/formats/room.md). Safe for untrusted input:
// nothing for bytes that are no brick.
Bytes encode_brick(const Brick& brick);
std::optional<Brick> decode_brick(ByteView properties);

struct PlacedBrick {
    Brick brick;
    Pose room_from_brick;
};

// The pose that a brick takes if it is released at `released`: on or under the nearest fitting
// studs of `others` if its corners lie within 2.5 cm of there and it is turned by less than 20
// degrees, otherwise `released`. Scales of all are 1.
Pose snapped(const Brick& brick, const Pose& released, const std::vector<PlacedBrick>& others);

render::MeshData make_brick_mesh(const Brick& brick);

}  // namespace theatron::room
