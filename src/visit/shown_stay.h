// SPDX-License-Identifier: Apache-2.0
// A stay in a viewer: the panels get the state of voice, face and devices, and what the person
// chooses there is carried out.
#pragma once

#include "sound/device_watch.h"
#include "viewer/viewer.h"
#include "visit/stay.h"

namespace theatron::visit {

// From one thread. Both must outlive it.
class ShownStay {
public:
    ShownStay(Stay& stay, viewer::Viewer& viewer) : stay_(stay), viewer_(viewer) {}

    // Once for each picture: Stay::tick(), and both directions between panels and stay. `talks`:
    // the key of push to talk is down.
    void tick(bool talks, TimePoint now);
    // The person's head, for voices that come from where people stand; after a picture's step.
    void place_voices();

private:
    void follow_voice(TimePoint now);

    Stay& stay_;
    viewer::Viewer& viewer_;
    sound::DeviceWatch devices_;
    TimePoint next_voices_{};
};

}  // namespace theatron::visit
