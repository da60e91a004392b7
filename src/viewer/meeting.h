// SPDX-License-Identifier: Apache-2.0
// The people and shared objects of a session's room, as one participant sees them.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "client/participant.h"
#include "render/pick.h"
#include "room/bricks.h"
#include "room/mark_scene.h"
#include "room/people.h"
#include "room/teleport_marks.h"
#include "session/expression_track.h"
#include "session/pose_track.h"
#include "viewer/case_scene.h"
#include "viewer/own_heads.h"
#include "viewer/room_past.h"
#include "viewer/shared_screens.h"
#include "viewer/tools/hold.h"
#include "viewer/worn_headsets.h"

namespace theatron::viewer {

// Use from one thread, with the same GL context current.
class Meeting {
public:
    // The pose of a person is stale if it is older than this.
    static constexpr Duration stale_after = std::chrono::seconds(2);
    // A call of a person to the others lasts this long.
    static constexpr Duration called_for = std::chrono::seconds(20);

    // The screens that are drawn and held with the objects of the room; they must outlive the
    // meeting.
    void set_screens(SharedScreens& screens) { screens_ = &screens; }

    // The people who are seen as point clouds, from the next take().
    void set_clouds(std::set<ParticipantId> people) { clouds_ = std::move(people); }

    // The colours of skin that are seen in clouds (cloud_skin.h), from the next take().
    void set_cloud_skins(std::map<ParticipantId, Vec3> skins) { skins_ = std::move(skins); }

    // The pictures of faces on the heads of these people, in the next pictures; their textures must
    // exist until the next call.
    void set_faces(std::map<ParticipantId, room::FacePicture> faces) { faces_ = std::move(faces); }

    // Shows or hides the age of each person in the room; that of an old view is always shown.
    void set_ages_shown(bool shown) { shows_ages_ = shown; }

    // The others who speak, with their levels (Voices). True if the picture changes.
    bool set_speaking(const std::map<ParticipantId, int>& levels_db);

    // The bricks, organs and marks that are drawn and met by rays are those of this moment of the
    // session's time, from the next take(), and other people are marked as being of now; nullopt:
    // the present.
    void show_moment(std::optional<TimePoint> moment) { moment_ = moment; }
    // False: the objects of the moment that is shown are not known, since this person came later.
    bool knows_shown_moment() const { return !moment_ || past_.knows(*moment_); }

    // Takes over new objects, people and poses. True if the picture changes.
    bool take(const client::Participant& participant);
    // True while people move although no pose arrives (session/pose_track.h).
    bool is_moving(TimePoint session_time) const;

    void add_to(render::SceneFrame& frame, const render::CameraView& view);

    // The arc of this person's own teleport, while it is aimed.
    void set_arc(std::optional<room::TeleportArc> arc) { arc_ = std::move(arc); }

    // This person's own hands, in a headset: y up, -z forward.
    void set_own_hands(std::optional<Pose> left, std::optional<Pose> right) {
        own_hands_ = {left, right};
    }

    // A mark that this person is making, before the host has it.
    void set_new_mark(std::optional<session::Mark> mark) { new_mark_ = std::move(mark); }

    // The nearest object that can be held on a ray.
    struct Hit {
        session::ObjectId object{};
        render::Picked picked;
    };
    std::optional<Hit> pick(const render::PickRay& ray, const render::CameraView& view);

    // The case that is open in the room.
    CaseScene& case_scene() { return case_; }
    const CaseScene& case_scene() const { return case_; }

    // The room for holding; valid until take().
    HoldRoom held_room() const {
        return {room_.self, room_.objects, people_, case_.in_room(), &case_};
    }

    // The name of another participant; empty if it is not in the room.
    std::string name_of(ParticipantId id) const;

    // The heads of those who show their own face.
    const OwnHeads& own_heads() const { return own_heads_; }

    const std::vector<room::RoomPerson>& people() const { return people_; }
    // As it is now.
    const client::Participant::Room& room() const { return room_; }
    // Another person whose head has a pose; null if there is none of this number.
    const room::RoomPerson* person(ParticipantId id) const;

private:
    bool take_past();
    void take_expressions(const client::Participant& participant, TimePoint now);
    const session::RoomObjects& shown() const { return shows_past_ ? then_ : room_.objects; }
    const render::SceneMesh& mesh_of(const room::Brick& brick);
    void add_teleports(render::SceneFrame& frame);
    void add_holder(render::SceneFrame& frame, session::ObjectId id,
                    const session::RoomObject& object, Vec3 eye);

    SharedScreens* screens_ = nullptr;
    std::uint64_t version_ = 0;
    client::Participant::Room room_;
    RoomPast past_;
    std::optional<TimePoint> moment_;
    bool shows_past_ = false;
    session::RoomObjects then_;  // at moment_
    std::vector<room::RoomPerson> people_;
    std::set<ParticipantId> clouds_;
    std::map<ParticipantId, Vec3> skins_;
    std::map<ParticipantId, room::FacePicture> faces_;
    bool shows_ages_ = false;
    std::map<ParticipantId, std::string> meters_;  // of those who speak
    std::map<ParticipantId, session::PoseTrack> tracks_;
    std::map<ParticipantId, session::ExpressionTrack> expressions_;
    OwnHeads own_heads_;
    WornHeadsets headsets_;
    TimePoint taken_at_;  // session time
    std::optional<room::TeleportArc> arc_;
    std::array<std::optional<Pose>, 2> own_hands_;
    std::unique_ptr<room::TeleportMarks> marks_;  // made for the first teleport
    std::unique_ptr<room::People> avatars_;       // created for the first other person
    std::map<std::tuple<int, int>, render::SceneMesh> bricks_;
    CaseScene case_;
    room::MarkScene mark_scene_;
    std::optional<session::Mark> new_mark_;
};

// All people of the room except room.self, with these poses. `now` is session time.
std::vector<room::RoomPerson> people_of(const client::Participant::Room& room,
                                        const std::map<ParticipantId, wire::PersonPose>& poses,
                                        TimePoint now);

// The face that an expression shows.
face::Channels channels_of(const wire::FaceExpression& expression);

// Poses of heads and hands for messages: y up, -z forward.
wire::PartPose part_of(const Pose& room_from_part);

// The pose of a person whose view is that of a camera at `room_from_eye` (z forward, y down).
wire::PersonPose pose_of_eye(const Pose& room_from_eye, TimePoint time);

}  // namespace theatron::viewer
