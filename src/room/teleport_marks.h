// SPDX-License-Identifier: Apache-2.0
// The marks of teleports: the arc of one that is aimed, with a ring where it lands, and particles
// that rise where somebody has left or arrived.
#pragma once

#include "render/scene_frame.h"
#include "room/moving.h"

namespace theatron::room {

// Needs the GL context current in which it was made.
class TeleportMarks {
public:
    static constexpr double effect_s = 0.9;  // for which particles are drawn

    TeleportMarks();

    void add_arc(render::SceneFrame& frame, const TeleportArc& arc, Vec3 color) const;
    // Particles at the floor below `head`, `age_s` after a teleport: 0 to effect_s.
    void add_effect(render::SceneFrame& frame, Vec3 head, Vec3 color, double age_s) const;

private:
    render::SceneMesh ball_, ring_;
};

}  // namespace theatron::room
