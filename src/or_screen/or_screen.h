// SPDX-License-Identifier: Apache-2.0
// A participant's view for a monitor in the operating room: nobody handles it.
//
// It has no loop, no window, no thread and no clock: the program that shows it owns these and
// passes time in.
#pragma once

#include <optional>
#include <set>

#include "or_screen/camera_choice.h"
#include "or_screen/drawing.h"
#include "render/render_target.h"
#include "viewer/live_scene.h"

namespace theatron::or_screen {

// Use from one thread, with the same GL context current, also in the destructor. For one
// participant.
class OrScreen {
public:
    OrScreen();

    // Takes over the session's changes. True if the screen must be drawn again.
    bool step(client::Participant& participant, const std::set<ParticipantId>& speaking,
              Size screen, TimePoint now);
    // The texts and marks that draw() shows.
    const Content& content() const { return content_; }

    void draw(const render::DrawTarget& target, TimePoint now);
    // The last picture is on the screen, this long after draw() began: drawing the room takes at
    // most a fifth of the time.
    void on_drawn(Duration took, TimePoint now);

    // A picture of a camera, or the certainty that there are none, has come.
    bool has_picture() const { return scene_.has_picture() || scene_.is_without_cameras(); }
    // The camera that is shown.
    std::optional<CameraId> camera() const { return camera_; }

private:
    std::vector<CameraScore> scores_for(const std::vector<Vec3>& places) const;
    void choose_camera(const std::set<ParticipantId>& speaking, TimePoint now);
    void take_picture();
    void take_slice();
    void describe(client::Participant& participant, const std::set<ParticipantId>& speaking,
                  TimePoint now);
    void describe_people(client::Participant& participant, const std::set<ParticipantId>& speaking);
    void describe_marks();
    void describe_heads();
    void point();
    std::optional<Vec2> slice_pixel(Vec3 place) const;
    PicturePlace in_picture(Vec3 place) const;
    render::CameraView room_view() const;
    Size room_size() const;
    void draw_room(TimePoint now);

    viewer::LiveScene scene_;
    CameraChoice choice_;
    Drawing drawing_;
    Content content_;
    Layout layout_;
    Size screen_;

    std::set<CameraId> live_;
    std::map<CameraId, client::CameraFigures> figures_;
    std::optional<CameraId> camera_;
    receive::CameraFramePtr frame_;  // that is shown
    render::PictureTexture picture_, slice_;
    const medical::Volume* slice_of_ = nullptr;
    std::optional<session::CaseScreen> slice_shown_;
    std::optional<medical::SlicePlane> slice_plane_;
    std::vector<std::pair<ParticipantId, Vec3>> pointed_;  // where people point in the room

    std::optional<render::RenderTarget> room_;
    bool room_changed_ = true, room_drawn_ = false;
    TimePoint next_room_, next_facts_;
};

}  // namespace theatron::or_screen
