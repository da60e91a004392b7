// SPDX-License-Identifier: Apache-2.0
// The pointing of people: a dotted ray to the surface that it meets, and there a dot with the name;
// another dot where that place is seen a second time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/ids.h"
#include "render/scene_frame.h"

namespace theatron::room {

struct Pointer {
    ParticipantId id{};  // whose colour it has
    std::string name;
    Vec3 from, direction;           // of length 1
    std::optional<double> reach_m;  // to the surface; none: it meets none
    // Where the same place is seen a second time: of an organ on its slice, and the reverse.
    std::optional<Vec3> twin = {};
};

// The dot at the end of a ray. Pure.
render::LinePiece pointer_end(Vec3 place);

// Needs the GL context current in which it was made.
class Pointers {
public:
    // A ray that meets nothing ends there.
    static constexpr double free_reach_m = 3;

    Pointers();
    void add_to(render::SceneFrame& frame, const std::vector<Pointer>& pointers) const;

private:
    render::SceneMesh ball_;
    render::SceneLineMesh end_;
};

}  // namespace theatron::room
