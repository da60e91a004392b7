// SPDX-License-Identifier: Apache-2.0
// Pointing and drawing over the 2D view's picture: the marks of the room's live cloud, the pointers
// of the others, and what this person does there with mouse or finger.
//
// The surface below the pointer comes from the camera's depth, which is asked for only while
// somebody points or draws, and a little longer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/participant.h"
#include "room/people.h"
#include "viewer/flat/flat_drawing.h"
#include "viewer/flat/flat_tools.h"
#include "window/input_queue.h"

namespace theatron::web {

// For the page's one thread.
class FlatMarks {
public:
    // `participant` must outlive this.
    explicit FlatMarks(client::Participant& participant) : participant_(participant) {}

    // The camera whose picture is shown: with colour. `measures`: it has depth that can be drawn
    // on.
    void show(CameraId camera, const Calibration& calibration, bool measures);
    void show_nothing() { shown_.reset(); }
    // A frame of that camera, or of another one, which is left out.
    void take(const receive::CameraFramePtr& frame);
    bool wants_depth() const { return wants_depth_; }
    // The person has chosen to point, and may do so with the next press of a finger.
    void expect_pointing(bool expected) { expects_pointing_ = expected; }

    viewer::ToolKind chosen() const { return tools_.chosen(); }
    bool is_drawing() const { return tools_.drawn() != nullptr; }
    void choose(viewer::ToolKind tool) { tools_.choose(tool); }
    // The next step in the page's rhythm takes all of `input`. Sentences for the person are added
    // to `notes`.
    void step(window::InputQueue& input, TimePoint now, std::vector<std::string>& notes);
    // The lines and labels as JSON for page/flat_marks.js; empty if they are those of the last
    // call.
    std::string take_drawing(TimePoint now);

private:
    struct Shown {
        CameraId camera{};
        Calibration calibration;
        bool measures = false;
        receive::CameraFramePtr frame;  // the newest with depth; may be null
    };
    bool measures() const { return shown_ && shown_->measures; }
    void on_key(const window::KeyPress& key, wire::Role role, std::vector<std::string>& notes);
    void follow_room(TimePoint now);
    void send_pointing(TimePoint now);
    std::optional<viewer::FlatPicture> picture() const;
    viewer::FlatDrawing drawing() const;

    client::Participant& participant_;
    viewer::FlatTools tools_;
    std::optional<Shown> shown_;
    client::Participant::Room room_;
    std::vector<session::Mark> marks_;        // of room_
    std::vector<room::RoomPerson> pointing_;  // the others who point now
    bool expects_pointing_ = false;
    bool wants_depth_ = false;
    TimePoint needed_;            // depth, last
    bool told_pointing_ = false;  // the others know that this person points
    TimePoint told_;
    TimePoint drawn_;
    std::string drawing_;
};

}  // namespace theatron::web
