// SPDX-License-Identifier: Apache-2.0
// Handling of the room's objects by mouse and keyboard: create, hold, move, turn, give, release,
// remove.
#pragma once

#include <optional>
#include <string>

#include "client/participant.h"
#include "viewer/meeting.h"
#include "viewer/tools/hold.h"
#include "viewer/tools/slice.h"
#include "window/window_input.h"

namespace theatron::viewer {

// Use from one thread.
class Handling {
public:
    // A new brick appears at this distance in front of the eye.
    static constexpr double new_brick_distance_m = 0.8;

    // Removes the input for objects from `input`; the rest steers the eye. `surface_m` is the
    // distance of the cloud at input.grabbed, along the view's axis: an object behind it cannot be
    // grabbed. `aspect` is the picture's width divided by its height.
    // `part`: a part of an organ is held, not the organ.
    void on_input(window::WindowInput& input, bool part, std::optional<double> surface_m,
                  double aspect, const render::CameraView& view, Meeting& meeting,
                  client::Participant& participant, TimePoint now);

    // Asks for a new brick before an eye.
    void make_brick(const render::CameraView& view, client::Participant& participant);

    bool holds() const { return hold_.holds(); }

    // The newest sentence for the user since the last call; may be empty.
    std::string take_note();

private:
    void grab(Vec2 pointer, bool part, std::optional<double> surface_m,
              const render::CameraView& view, Meeting& meeting, client::Participant& participant);
    void change_width(window::WindowInput& input, const HoldRoom& room);
    void pass(const HoldStep& step, client::Participant& participant);
    void on_key(window::Action action, const render::CameraView& view, const Meeting& meeting,
                client::Participant& participant);

    Hold hold_;
    Vec2 pointer_;  // of the mouse that holds: shares of the picture's width and height
    ScreenHandling screen_;
    std::uint8_t next_color_ = 0;
    std::string note_;
};

}  // namespace theatron::viewer
