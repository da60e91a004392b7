// SPDX-License-Identifier: Apache-2.0
#include "face/face_input.h"

namespace theatron::face {

std::string_view to_text(Tracking tracking) {
    switch (tracking) {
        case Tracking::waiting:
            return "waiting";
        case Tracking::tracked:
            return "tracked";
        case Tracking::relaxing:
            return "relaxing";
        case Tracking::lost:
            return "lost";
    }
    return "";
}

FaceNow FaceInput::at(TimePoint now) const {
    FaceNow face;
    if (!at_)
        return face;
    const Duration age = now - *at_;
    if (age >= neutral_after) {
        face.tracking = Tracking::lost;
        return face;
    }
    face.values = last_.values;
    face.present = last_.present;
    if (age < silent_after) {
        face.tracking = Tracking::tracked;
        return face;
    }
    face.tracking = Tracking::relaxing;
    // Starts and ends without a jerk.
    const float t =
        float(to_seconds(age - silent_after) / to_seconds(neutral_after - silent_after));
    const float rest = 1 - t * t * (3 - 2 * t);
    for (float& value : face.values)
        value *= rest;
    return face;
}

}  // namespace theatron::face
