// SPDX-License-Identifier: Apache-2.0
// Tools with which a person works in the room: they follow a pointer, which is the mouse, a
// controller or a hand. Without a tool a pointer holds objects (hold.h).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "client/participant.h"
#include "phrases/phrase.h"
#include "session/mark.h"
#include "viewer/cloud_pick.h"
#include "viewer/meeting.h"

namespace theatron::viewer {

struct Pointer {
    std::optional<render::PickRay> ray;  // in the room, metres; none: the mouse left the window
    bool presses = false;                // the button, the trigger or the pinch has just closed
    bool releases = false;               // it has just opened
};

// The room that a tool works on during a call.
struct ToolScene {
    Meeting& meeting;
    const render::CameraView& view;         // of the person
    const std::vector<CloudCamera>& cloud;  // empty where the clouds are not drawn
    client::Participant& participant;
    TimePoint now;
};

// The surface that a ray meets: an object of the room or the live cloud, whatever is nearer.
struct SurfacePoint {
    session::MarkedSurface surface{};
    session::ObjectId object{};  // the part of an organ or the screen; none of the cloud
    Vec3 place, normal;          // in the room
    std::optional<room::MeasuredPoint> measured;  // of the cloud
};
// Nullopt where there is none, and where a brick or the bar of a screen is nearest.
std::optional<SurfacePoint> surface_at(const render::PickRay& ray, const render::CameraView& view,
                                       Meeting& meeting, const std::vector<CloudCamera>& cloud);

// Use from one thread, each from its choice to its end.
class Tool {
public:
    virtual ~Tool() = default;
    // True while the tool uses the pointer: from a press that it takes to the release.
    virtual bool on_pointer(const Pointer& pointer, const ToolScene& scene) = 0;
    // True while it shows something that follows the pointer, also between two presses.
    virtual bool follows_pointer() const { return false; }
    // Tells a person who does not know the tool yet the next step. Given once.
    virtual std::optional<Phrase> take_advice() { return std::nullopt; }
    // The person puts the tool away, perhaps in the middle of its work.
    virtual void end(Meeting&) {}
};

enum class ToolKind { none, stroke, arrow, pin, distance, slice, cut, part };

// A row of buttons in the panel of tools.
struct ToolRow {
    struct Choice {
        ToolKind kind{};
        Phrase name{};
    };
    Phrase name{};
    bool needs_case = false;  // one that is open
    std::vector<Choice> choices;
};
const std::vector<ToolRow>& tool_rows();
// The marks that a tool makes; none: it makes no marks.
std::optional<session::MarkKind> marks_of(ToolKind kind);
Phrase name_of(ToolKind kind);

// The tool that the person has chosen. Use from one thread.
class Tools {
public:
    ToolKind chosen() const { return chosen_; }
    bool any() const { return chosen_ != ToolKind::none; }  // is chosen
    void choose(ToolKind kind, Meeting& meeting);
    // Single parts of an organ are held instead of the organ.
    bool takes_parts() const { return chosen_ == ToolKind::part; }
    // As those of Tool; false and nothing without a tool.
    bool on_pointer(const Pointer& pointer, const ToolScene& scene) {
        return tool_ && tool_->on_pointer(pointer, scene);
    }
    bool follows_pointer() const { return tool_ && tool_->follows_pointer(); }
    // Drops what is being drawn. False: nothing is.
    bool give_up(Meeting& meeting) {
        if (!follows_pointer())
            return false;
        tool_->end(meeting);
        return true;
    }
    std::optional<Phrase> take_advice() { return tool_ ? tool_->take_advice() : std::nullopt; }

private:
    ToolKind chosen_ = ToolKind::none;
    std::unique_ptr<Tool> tool_;  // null: the pointer holds objects
};

}  // namespace theatron::viewer
