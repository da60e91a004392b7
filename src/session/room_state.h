// SPDX-License-Identifier: Apache-2.0
// The host's shared room: it decides on each request, in the order of arrival.
//
// A pure state machine: time and participants are passed in, results are returned.
#pragma once

#include <optional>
#include <set>
#include <utility>

#include "session/room_object.h"

namespace theatron::session {

class RoomState {
public:
    static constexpr std::size_t max_objects = 2048;
    static constexpr std::size_t max_objects_of_one = 512;             // created by one participant
    static constexpr std::size_t max_property_bytes = 4096;            // of one object
    static constexpr std::size_t max_property_bytes_of_all = 1 << 18;  // so a snapshot is small
    static constexpr double min_scale = 0.01, max_scale = 100;
    static constexpr double max_coordinate_m = 1000;

    RoomState() = default;
    // Continues from a snapshot, for example after a restart of the host. No object is held, and
    // marks have no creator: numbers of participants begin again.
    explicit RoomState(const ObjectsSnapshot& snapshot);

    // Creates the participant's person object with these properties; `joined`, session time,
    // becomes its moved_at. Only the host changes it.
    ObjectChange on_joined(ParticipantId participant, Bytes properties, TimePoint joined = {});
    // Changes the properties of the participant's person object, if it has one.
    std::vector<ObjectChange> on_person(ParticipantId participant, Bytes properties);
    // Releases the objects that it holds where they are.
    std::vector<ObjectChange> release_all(ParticipantId participant);
    // Removes all objects but people and the shared screens whose source is here.
    std::vector<ObjectChange> clear();
    // Removes these objects, or makes another participant their creator.
    std::vector<ObjectChange> remove(const std::vector<ObjectId>& objects);
    std::vector<ObjectChange> set_creator(const std::vector<ObjectId>& objects, ParticipantId to);
    // The host's own change: adds the object, or replaces `id`. nullopt, and nothing has changed:
    // the room is full, or the object is beyond its limits.
    std::optional<ObjectChange> put(std::optional<ObjectId> id, RoomObject object);
    // As release_all(), and removes its person object.
    std::vector<ObjectChange> on_left(ParticipantId participant);

    struct Decision {
        Refusal refusal = Refusal::none;
        std::vector<ObjectChange> changes;  // for all participants
    };
    // `may_change`: the participant's role allows to change the room.
    Decision on_request(ParticipantId from, std::uint32_t number, const Request& request,
                        bool may_change);

    // Removes all organs and screens of a case, the marks on them, and adds these objects, all or
    // none.
    Decision replace_case(ParticipantId by, std::vector<RoomObject> objects);

    // Applies a pose. True, and it must be forwarded, if it belongs to the object's present grip,
    // `from` is the holder, and the pose is newer than the one before.
    bool on_pose(ParticipantId from, const ObjectPose& pose);

    ObjectsSnapshot snapshot() const { return {revision_, objects_}; }
    std::uint64_t revision() const { return revision_; }
    // The number of a change of objects that are kept elsewhere.
    std::uint64_t take_revision() { return ++revision_; }
    const RoomObjects& objects() const { return objects_; }

private:
    static bool is_sound(const Pose& pose, double scale);
    static bool may_be_at(const RoomObject& object, const Pose& pose, double scale);
    ObjectChange changed(ObjectId object);
    // True if an object may have `bytes` bytes of properties instead of `before`.
    bool has_room_for(std::size_t bytes, std::size_t before) const;
    // The object, if this grip holds it.
    std::pair<Refusal, RoomObject*> find_held(ObjectId object, const Grip& grip);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Create& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Remove& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Grab& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Release& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::HandOver& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::SetProperties& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::ClearMarks& request);

    std::uint64_t revision_ = 0;
    std::uint32_t newest_id_ = 0;
    RoomObjects objects_;
    std::set<ParticipantId> participants_;
    ObjectId touched_{};  // changed by the current request
};

}  // namespace theatron::session
