// SPDX-License-Identifier: Apache-2.0
// When the whole picture is covered because no camera's picture shows the present. Pure.
//
// A live picture that is older than pace::still_after never looks live. Where one camera of several
// stands still its cloud is faint and a warning names it; where all do, the picture is covered. Not
// covered: what is marked as not live already (a recording, the past, a picture that the person
// froze), cameras that are not shown here, and the first picture, which is still on its way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/participant_figures.h"

namespace theatron::viewer {

// A camera of the room as it is shown.
struct ShownCamera {
    // When its newest picture was taken, in session time; none: the first is still on its way.
    std::optional<TimePoint> newest;
    bool is_exempt = false;  // paused, replayed or of the past, which is marked, or not shown here
};

// The picture of this camera stands still.
bool stands_still(const ShownCamera& camera, TimePoint now);

// The time since the newest picture of all cameras, if each that has sent one stands still; nullopt
// where one does not, or is exempt.
std::optional<Duration> all_still(const std::vector<ShownCamera>& cameras, TimePoint now);

// A camera with its age as the figures have it, so that its times are right for `now`.
ShownCamera shown_camera(const client::CameraFigures& camera, TimePoint now);
// The cameras of the room. Screens, faces and cameras that see their publisher tell their ages
// themselves.
std::vector<ShownCamera> shown_cameras(const std::vector<client::CameraFigures>& cameras,
                                       TimePoint now);

// "No picture for 5 s"; empty for nullopt.
std::string still_text(std::optional<Duration> still);

}  // namespace theatron::viewer
