// SPDX-License-Identifier: Apache-2.0
// Marking with the mouse: the tool, and the mark that is being drawn onto the surface under it.
#pragma once

#include <optional>
#include <string>

#include "client/participant.h"
#include "viewer/cloud_pick.h"
#include "viewer/meeting.h"
#include "xr/window_input.h"

namespace theatron::viewer {

// The surface under the mouse: an object of the room or the live cloud, whatever is nearer.
struct SurfacePoint {
    session::MarkedSurface surface{};
    session::ObjectId object{};  // the part of an organ, the organ or the screen; none of the cloud
    Vec3 place, normal;          // in the room
    std::optional<room::MeasuredPoint> measured;  // of the cloud
};
// Nullopt where there is none, and where a brick or the bar of a screen is nearest.
std::optional<SurfacePoint> surface_at(Vec2 pointer, const render::CameraView& view,
                                       Meeting& meeting, const std::vector<CloudCamera>& cloud);

// Use from one thread.
class Marking {
public:
    // Nullopt: the mouse does not mark.
    const std::optional<session::MarkKind>& tool() const { return tool_; }
    void choose(std::optional<session::MarkKind> tool, Meeting& meeting);

    // Takes the left button and its drag out of `input` while a mark is drawn. True if the picture
    // changes.
    bool on_input(xr::WindowInput& input, const render::CameraView& view, Meeting& meeting,
                  const std::vector<CloudCamera>& cloud, client::Participant& participant);

private:
    struct Draft {
        SurfacePoint first, last;
        session::Mark mark;
    };
    bool begin(const SurfacePoint& at, const Meeting& meeting);
    void go_on(const SurfacePoint& at, const Meeting& meeting);
    bool is_worth_keeping() const;

    std::optional<session::MarkKind> tool_;
    std::optional<Draft> draft_;
};

}  // namespace theatron::viewer
