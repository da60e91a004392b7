// SPDX-License-Identifier: Apache-2.0
// The room of a session at a participant: takes messages of the host, and returns requests and
// poses for the host. RoomReplica keeps the objects; this class reads and writes the messages.
//
// Without sockets, threads or clock.
#pragma once

#include <deque>
#include <optional>

#include "session/room_bytes.h"
#include "session/room_replica.h"
#include "wire/control.h"

namespace theatron::session {

class MemberRoom {
public:
    // A new connection has begun, with this number. Requests of the previous one are discarded.
    void begin(ParticipantId self);

    // ObjectsSnapshot, ObjectChange or RoomDecision. Safe for untrusted input: a damaged message
    // changes nothing.
    void on_message(const wire::ToParticipant& message);
    void on_pose(ObjectId object, ByteView body);

    // Returns the request's number; 0 if the room is not known yet.
    std::uint32_t ask(const Request& request);
    // Moves an object (metres) that this participant holds. False if it does not hold it.
    bool move(ObjectId object, const Pose& room_from_object, double scale, TimePoint now);

    // Messages for the host, in order; and the newest pose of each moved object.
    std::vector<wire::RoomRequest> take_requests();
    std::map<ObjectId, Bytes> take_poses();

    // The objects as the host decided, changed by this participant's undecided requests.
    RoomObjects objects() const { return known_ ? replica_.predicted() : RoomObjects(); }
    // The objects as the host decided.
    const RoomObjects& confirmed() const { return replica_.confirmed(); }
    bool known() const { return known_; }
    ParticipantId self() const { return self_; }
    // Grows with each change, of others or of this participant.
    std::uint64_t version() const { return version_; }
    // The oldest refusal not taken yet, with the request's number; if any.
    std::optional<std::pair<std::uint32_t, Refusal>> take_refusal();

private:
    void on(const wire::RoomSnapshot& part);
    void on(const wire::RoomChange& change);
    void on(const wire::RoomDecision& decision);
    void send_object_pose(const ObjectPose& pose);

    ParticipantId self_{};
    bool known_ = false;
    std::uint64_t version_ = 0;
    RoomReplica replica_{ParticipantId{}};
    ObjectsSnapshot gathered_;  // from the parts received so far
    std::uint16_t next_part_ = 0;
    bool asked_for_snapshot_ = false;
    std::vector<wire::RoomRequest> requests_;
    std::map<ObjectId, Bytes> poses_;
    std::deque<std::pair<std::uint32_t, Refusal>> refusals_;
};

}  // namespace theatron::session
