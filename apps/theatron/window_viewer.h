// SPDX-License-Identifier: Apache-2.0
// theatron join with a window: look around in the live scene.
#pragma once

#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "base/statistics.h"
#include "client/participant.h"
#include "session/renderer_choice.h"
#include "viewer/live_scene.h"
#include "viewer/view_choice.h"
#include "window_status.h"
#include "xr/desktop_window_native.h"
#include "xr/drawing_pace.h"
#include "xr/overlay_native.h"
#include "xr/scaled_picture_native.h"

namespace theatron::app {

class WindowViewer {
public:
    struct Options {
        client::Participant::Options join;
        Size size{1280, 720};
        viewer::ViewChoice view;
        viewer::RoomChoice room;
        std::vector<viewer::SeenPerson> people;
        std::string renderer = "auto";
        double scale = 0;    // of the window's pixels to draw; 0: as there is time for
        double seconds = 0;  // end this long after the first picture; 0: never
    };

    // Opens the window and begins to join. Throws Error where one of them cannot be done.
    explicit WindowViewer(Options options);

    // Returns when the person leaves. Throws Error if the host refused to let them in.
    void run();

private:
    client::Participant::Options with_callbacks(client::Participant::Options join);
    bool obey(const xr::WindowInput& input);
    void obey(const xr::KeyPress& key);
    void note(const std::string& text, Duration length);
    void choose_renderer();
    void follow_host();
    void choose_pace();
    const xr::DrawingWay& way() const { return pace_.way(); }
    void go_home(const viewer::ViewChoice& choice);
    void find_view();
    std::string camera_text(CameraId camera) const;
    render::CameraView view() const;
    void grab(Vec2 place);
    void steer(const xr::Steering& steering, TimePoint now);
    void update_texts(TimePoint now);
    void draw_scene();
    void draw(TimePoint begin);

    Options options_;
    xr::DesktopWindow window_;
    viewer::LiveScene scene_;
    xr::ScaledPicture picture_;
    xr::Overlay overlay_;

    // What is looked at. The eye has the lens of the camera whose view it started from.
    std::optional<xr::Viewpoint> viewpoint_;
    CameraModel lens_;
    Pose home_pose_;      // of that camera when the view started from it
    bool moved_ = false;  // away from the camera's own view
    bool flying_ = false;
    bool fading_ = false;  // a camera that stands still, or comes back
    TimePoint steered_at_, first_picture_at_;

    // What is drawn.
    session::RendererChoice choice_;
    std::string working_renderer_;
    xr::DrawingPace pace_;
    xr::OverlayContent texts_;
    std::string notice_, title_;
    TimePoint notice_until_, next_texts_;
    bool scene_changed_ = true, texts_changed_ = true;

    // What came out of it.
    std::set<CameraId> updated_;  // cameras whose new picture is not presented yet
    RateWindow drawn_;
    SampleWindow ages_{30}, all_ages_{20'000};
    std::uint64_t pictures_ = 0;
    TimePoint presented_at_;
    std::optional<double> age_at_presentation_;

    std::mutex mutex_;
    std::vector<std::string> remarks_;  // from the participant's thread

    client::Participant participant_;  // last: its thread uses the window and the remarks
};

}  // namespace theatron::app
