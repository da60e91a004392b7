// SPDX-License-Identifier: Apache-2.0
// The screen of a case: other slices, windows and pictures, and the mouse on it: the wheel scrolls,
// a drag changes the window.
#pragma once

#include <optional>

#include "viewer/meeting.h"
#include "xr/window_input.h"

namespace theatron::viewer {

// True if the surface that is drawn there, at this distance along the view's axis, hides a place of
// an object.
bool is_hidden(Vec3 place, std::optional<double> surface_m, const render::CameraView& view);

// The screen with another slice: some slices further; of another orientation, through its
// middle; through a place of the patient; of another series, whose window it takes if there is
// `volume`. All but the first show slices instead of pictures. Pure.
session::CaseScreen scrolled(const session::CaseScreen& screen, const medical::Volume& volume,
                             double slices);
session::CaseScreen turned(const session::CaseScreen& screen, const medical::Volume& volume,
                           medical::Orientation orientation);
session::CaseScreen through(const session::CaseScreen& screen, Vec3 patient_mm);
session::CaseScreen of_series(const session::CaseScreen& screen, int series,
                              const medical::Volume* volume);
// The screen with the picture that is `steps` further; the first one if it showed a slice. `count`:
// of the case, at least 1. Pure.
session::CaseScreen stepped(const session::CaseScreen& screen, int count, double steps);

// Use from one thread.
class ScreenHandling {
public:
    // The width of a picture in units of the window's centre and width.
    static constexpr double units_per_picture = 1200;

    // Takes what concerns the screen out of `input`.
    void on_input(xr::WindowInput& input, std::optional<double> surface_m, double aspect,
                  const render::CameraView& view, Meeting& meeting,
                  client::Participant& participant, TimePoint now);

private:
    void send(client::Participant& participant, TimePoint now);

    bool drags_window_ = false;
    // A host takes 40 changes of the room a second: a drag sends fewer, the last one always.
    static constexpr Duration send_interval = std::chrono::milliseconds(33);
    std::optional<session::CaseScreen> waiting_;
    TimePoint sent_;
};

}  // namespace theatron::viewer
