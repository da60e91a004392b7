// SPDX-License-Identifier: Apache-2.0
// The open case in the picture: its parts where the room has them, its slice on the screen and in
// the organ.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/participant.h"
#include "render/scene_frame.h"
#include "session/case_objects.h"
#include "viewer/monitor.h"

namespace theatron::viewer {

// Use from one thread, with the same GL context current.
class CaseScene {
public:
    // Takes over content that has come. `objects`: the room's. True if the picture changes.
    bool take(const client::Participant& participant, const session::RoomObjects& objects,
              bool objects_changed);

    void add_to(render::SceneFrame& frame, const render::CameraView& view);

    // The open case, as the room has it, and its content, which is described under the name that
    // the case has in the room; nullopt and null without a case.
    const std::optional<session::CaseInRoom>& in_room() const { return room_; }
    const client::OpenCase* content() const { return content_ ? &*content_ : nullptr; }
    // The place where a part or the organ is drawn, and its pose in the room's state for such a
    // place. Both give nullopt for other objects.
    std::optional<Pose> shown_pose(session::ObjectId object) const;
    std::optional<Pose> stored_pose(session::ObjectId object, const Pose& room_from_shown) const;
    // The patient coordinates of a place of the room on this part.
    std::optional<Vec3> patient_point(session::ObjectId part, Vec3 place) const;

    // The same place of the patient on the other of the two, organ and slice, for a place of the
    // room on a part or on the slice: nullopt if the slice does not show it.
    std::optional<Vec3> twin_place(session::ObjectId object, Vec3 place) const;

    // A part whose surface is here, shown, and not quite transparent.
    bool is_drawn(const session::CaseInRoom::Part& part) const;
    // A part that is shown and whose place is known, also before its surface has come, and where
    // it never comes: in the replay of a session whose case the host does not offer.
    bool has_place(const session::CaseInRoom::Part& part) const;
    // The removed side of the organ, if it is cut.
    std::optional<render::Cut> cut() const;
    std::optional<Monitor::SliceFrame> slice_frame() const;

    Monitor& monitor() { return monitor_; }
    const Monitor& monitor() const { return monitor_; }

private:
    struct Drawn {
        std::shared_ptr<const medical::Mesh> from;
        render::SceneMesh mesh;
        Vec3 middle;  // in the organ's frame
    };
    Pose exploded(const session::CaseInRoom::Part& part) const;  // relative to the organ
    const Drawn* drawn(std::size_t part) const;
    const medical::SharedCase* description() const;

    std::optional<session::CaseInRoom> room_;
    std::optional<client::OpenCase> content_;
    std::uint64_t version_ = 0;
    std::map<std::size_t, Drawn> drawn_;  // by part
    Monitor monitor_;
};

}  // namespace theatron::viewer
