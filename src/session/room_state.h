// SPDX-License-Identifier: Apache-2.0
// A shared room as the host keeps it: it decides on every request, in the order of arrival.
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
    // Goes on from a snapshot, for example after the host was started again. Nobody holds anything.
    explicit RoomState(const RoomSnapshot& snapshot);

    // Its person object appears, with these properties. Only the host creates and changes these.
    RoomChange on_joined(ParticipantId participant, Bytes properties);
    // The objects that it held are released where they are, and its person object is removed.
    std::vector<RoomChange> on_left(ParticipantId participant);

    struct Decision {
        Refusal refusal = Refusal::none;
        std::vector<RoomChange> changes;  // for everybody
    };
    // `may_change`: the participant's role allows to change the room.
    Decision on_request(ParticipantId from, std::uint32_t number, const Request& request,
                        bool may_change);

    // True if the pose counts, and is to be forwarded: it is of the object's present grip, `from`
    // holds it, and it is newer than the one before.
    bool on_pose(ParticipantId from, const ObjectPose& pose);

    RoomSnapshot snapshot() const { return {revision_, objects_}; }
    std::uint64_t revision() const { return revision_; }
    const RoomObjects& objects() const { return objects_; }

private:
    RoomChange changed(ObjectId object);
    // True if an object may have so many bytes of properties instead of `before`.
    bool has_room_for(std::size_t bytes, std::size_t before) const;
    // The object, if this grip holds it.
    std::pair<Refusal, RoomObject*> find_held(ObjectId object, const Grip& grip);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Create& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Remove& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Grab& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::Release& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::HandOver& request);
    Refusal apply(ParticipantId from, std::uint32_t number, const request::SetProperties& request);

    std::uint64_t revision_ = 0;
    std::uint32_t newest_id_ = 0;
    RoomObjects objects_;
    std::set<ParticipantId> participants_;
    ObjectId touched_{};  // by the request that is applied
};

}  // namespace theatron::session
