// SPDX-License-Identifier: Apache-2.0
// What a person does with the objects of the room by mouse and keyboard: hold, move, turn, give,
// put back.
#pragma once

#include <optional>
#include <string>

#include "client/participant.h"
#include "viewer/grasp.h"
#include "viewer/meeting.h"
#include "xr/window_input.h"

namespace theatron::viewer {

// Use from one thread.
class Handling {
public:
    // Before it, a new brick appears.
    static constexpr double new_brick_distance_m = 0.8;

    // Takes what concerns objects out of `input`; the rest steers the eye. `surface_m` is the
    // distance of the cloud at input.grabbed, along the view's axis: an object behind it is not
    // held. `aspect` is the picture's width over its height.
    void on_input(xr::WindowInput& input, std::optional<double> surface_m, double aspect,
                  const render::CameraView& view, Meeting& meeting,
                  client::Participant& participant);

    // A sentence for the person since the last call; may be empty.
    std::string take_note();

private:
    struct Held {
        session::ObjectId object{};
        std::uint32_t grip = 0;  // the number of the request
        Grasp grasp;
        Vec2 pointer;  // shares of the picture's width and height
        double scale = 1;
    };
    void grab(Vec2 pointer, std::optional<double> surface_m, const render::CameraView& view,
              Meeting& meeting, client::Participant& participant);
    void release(const Meeting& meeting, client::Participant& participant);
    void on_key(xr::Action action, const render::CameraView& view, const Meeting& meeting,
                client::Participant& participant);

    std::optional<Held> held_;
    std::uint8_t next_color_ = 0;
    std::string note_;
};

}  // namespace theatron::viewer
