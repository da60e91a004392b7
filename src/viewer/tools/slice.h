// SPDX-License-Identifier: Apache-2.0
// The screen of a case: other slices, windows and pictures; the tools that move and turn its slice
// and cut the organ there; and the mouse on it: the wheel scrolls, a drag changes the window.
#pragma once

#include <optional>

#include "viewer/tools/tool.h"
#include "window/window_input.h"

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

// The slice through the place that a ray meets on a part of the organ; on the slice itself, through
// that place in the next orientation.
struct SliceHit {
    session::CaseScreen screen;
    session::ObjectId part{};  // 0: the slice
    double distance_m = 0;     // from the ray's beginning
};
std::optional<SliceHit> slice_at(const render::PickRay& ray, const render::CameraView& view,
                                 Meeting& meeting);

// A screen that this person wants. A host takes 40 changes of the room a second: a drag sends
// fewer, the last one always.
class WantedScreen {
public:
    static constexpr Duration send_interval = std::chrono::milliseconds(33);

    void want(const session::CaseScreen& screen) { waiting_ = screen; }
    void forget() { waiting_.reset(); }
    const std::optional<session::CaseScreen>& waiting() const { return waiting_; }
    void send(client::Participant& participant, TimePoint now);

private:
    std::optional<session::CaseScreen> waiting_;
    TimePoint sent_;
};

// A press on the organ brings the slice there; with the ray it moves on through the organ until the
// release. A press on the slice turns it into the next orientation.
class SliceTool : public Tool {
public:
    // `cuts`: the organ is cut at the slice, too. A press beside the organ makes it whole again.
    explicit SliceTool(bool cuts) : cuts_(cuts) {}

    bool on_pointer(const Pointer& pointer, const ToolScene& scene) override;

private:
    bool begin(const render::PickRay& ray, const ToolScene& scene);
    void move(const render::PickRay& ray, const ToolScene& scene);

    bool cuts_ = false;
    std::optional<SliceHit> held_;
    WantedScreen wanted_;
};

// Use from one thread.
class ScreenHandling {
public:
    // The width of a picture in units of the window's centre and width.
    static constexpr double units_per_picture = 1200;

    // Takes what concerns the screen out of `input`.
    void on_input(window::WindowInput& input, std::optional<double> surface_m, double aspect,
                  const render::CameraView& view, Meeting& meeting,
                  client::Participant& participant, TimePoint now);

private:
    bool drags_window_ = false;
    WantedScreen wanted_;
};

}  // namespace theatron::viewer
