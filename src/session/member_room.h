// SPDX-License-Identifier: Apache-2.0
// The room of a session at a participant: messages of the host go in, requests and poses for the
// host come out. RoomReplica keeps the objects; this class speaks the messages.
//
// Pure; time is passed in.
#pragma once

#include <deque>
#include <optional>

#include "session/room_bytes.h"
#include "session/room_replica.h"
#include "wire/control.h"

namespace theatron::session {

class MemberRoom {
public:
    // A new connection is welcomed as `self`. What was asked for on the one before is forgotten.
    void begin(ParticipantId self);

    // RoomSnapshot, RoomChange or RoomDecision. Safe for untrusted input: what is damaged changes
    // nothing.
    void on_message(const wire::ToParticipant& message);
    void on_pose(ObjectId object, ByteView body);

    // Returns the request's number; 0 if the room is not known yet.
    std::uint32_t ask(const Request& request);
    // A pose of an object that this participant holds. False if it does not hold it.
    bool move(ObjectId object, const Pose& room_from_object, double scale, TimePoint now);

    // Messages for the host, in order; and the newest pose of each moved object.
    std::vector<wire::RoomRequest> take_requests();
    std::map<ObjectId, Bytes> take_poses();

    // As the host decided, with what this participant asked for and the host has not decided on.
    RoomObjects objects() const { return known_ ? replica_.predicted() : RoomObjects(); }
    bool known() const { return known_; }
    ParticipantId self() const { return self_; }
    // Grows with every change that others or this participant make.
    std::uint64_t version() const { return version_; }
    // The refusal of a request, oldest first.
    std::optional<std::pair<std::uint32_t, Refusal>> take_refusal();

private:
    void on(const wire::RoomSnapshot& part);
    void on(const wire::RoomChange& change);
    void on(const wire::RoomDecision& decision);
    void send_pose(const ObjectPose& pose);

    ParticipantId self_{};
    bool known_ = false;
    std::uint64_t version_ = 0;
    RoomReplica replica_{ParticipantId{}};
    RoomSnapshot gathered_;  // of the parts so far
    std::uint16_t next_part_ = 0;
    bool asked_for_snapshot_ = false;
    std::vector<wire::RoomRequest> requests_;
    std::map<ObjectId, Bytes> poses_;
    std::deque<std::pair<std::uint32_t, Refusal>> refusals_;
};

}  // namespace theatron::session
