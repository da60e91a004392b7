// SPDX-License-Identifier: Apache-2.0
// --person and --myself: the place of a person in a camera's picture, so that the room behind them,
// or the viewer's own body, is cut off. "1=0.2:1.65:-0.4,yaw=90" is a person seen by camera 1 whose
// head is 1.65 m above the floor and turned towards -x.
#pragma once

#include <string>
#include <vector>

#include "geometry/calibration.h"
#include "geometry/vec.h"
#include "image/view.h"
#include "render/cloud_cut.h"

namespace theatron::viewer {

enum class Seen { other, oneself };

struct SeenPerson {
    std::string camera;  // its number or name
    Seen who = Seen::other;
    // Between the eyes: x right, y down, z forward.
    Pose room_from_head;
    double reach_m = 0;

    render::CloudCut cut() const {
        return who == Seen::oneself ? render::oneself(room_from_head, reach_m)
                                    : render::other_person(room_from_head, reach_m);
    }
};

// CAMERA=X:Y:Z with yaw=, pitch= (degrees) and reach= (metres) behind commas. Throws Error with one
// sentence if it is not understood.
SeenPerson parse_seen_person(const std::string& text, Seen who);

// All of the two options. Throws Error also if there are two people for one camera.
std::vector<SeenPerson> parse_seen_people(const std::vector<std::string>& others,
                                          const std::vector<std::string>& oneself);

// Empty where the camera's picture has a point within the person's reach; else a sentence, since
// nothing of that camera is drawn then.
std::string nothing_seen(const SeenPerson& person, const Calibration& calibration, DepthView depth);

}  // namespace theatron::viewer
