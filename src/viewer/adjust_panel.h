// SPDX-License-Identifier: Apache-2.0
// The panel with which operators move and turn a camera a little, and draw its region, for all who
// see it.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "client/participant.h"
#include "session/camera_adjustment.h"
#include "viewer/drawn_region.h"
#include "viewer/room_panel.h"
#include "window/window_input.h"

namespace theatron::viewer {

// Use from one thread.
class AdjustPanel {
public:
    // For one key press or click.
    static constexpr double step_m = 0.005, step_deg = 0.5;
    // Fewer than a host takes of decisions (session/request_budget.h).
    static constexpr Duration send_every = std::chrono::milliseconds(150);

    bool is_shown() const { return shown_; }
    void show(bool shown) {
        shown_ = shown;
        draws_ = draws_ && shown;
    }

    // The cameras of the room as they are described now.
    void take(const std::vector<client::Participant::Camera>& cameras);
    // The host refused: what was wanted is given up.
    void give_up() { wanted_.clear(); }

    void carry_out(const AdjustStep& step);
    // Moves the slider that `slide` named last.
    void slide(double value);
    // `yaw`: of the person's eye about the vertical, radians; 0 looks along -z.
    void nudge(window::Nudge nudge, double yaw);

    // While the person draws the region of the chosen camera: takes the left button's input away
    // from others. Returns a sentence for the person once the rectangle is complete.
    std::string draw(window::WindowInput& input, const render::CameraView& view,
                     const std::vector<CloudCamera>& cloud);
    std::optional<std::pair<Vec2, Vec2>> rectangle() const;

    // Sends what has changed, not too often.
    void on_tick(client::Participant& participant, TimePoint now);

    void add_panel(RoomPanel& panel) const;

private:
    struct Camera {
        CameraId id{};
        std::string name;
        session::CameraAdjustment adjustment;  // the host's
        bool has_region = false;               // it can have one
    };
    const Camera* chosen() const;
    session::CameraAdjustment current(const Camera& camera) const;
    void note_undo();
    void want(session::CameraAdjustment adjustment);

    bool shown_ = false;
    std::vector<Camera> cameras_;
    std::optional<CameraId> chosen_;
    int sliding_ = 0;  // the part
    bool draws_ = false;
    std::optional<ViewRectangle> drawn_;  // while the button is down
    // The person's wish that the host has not carried out yet.
    std::map<CameraId, session::CameraAdjustment> wanted_;
    std::map<CameraId, session::CameraAdjustment> sent_;
    TimePoint sent_at_;
    std::vector<std::pair<CameraId, session::CameraAdjustment>> undo_;  // the newest last
};

}  // namespace theatron::viewer
