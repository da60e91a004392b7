// SPDX-License-Identifier: Apache-2.0
// A participant's copy of the shared room: the host's decisions, and the predicted effect of its
// own requests before the host has decided on them.
//
// A pure state machine: messages and times are passed in, results are returned.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "session/room_object.h"

namespace theatron::session {

class RoomReplica {
public:
    explicit RoomReplica(ParticipantId self) : self_(self) {}

    // A request to be sent to the host; its effect is part of predicted() at once. Returns the
    // number to send with it.
    std::uint32_t request(const Request& request);
    // Moves an object (metres) that this participant holds, also if the host has not decided yet.
    // Returns the pose to send to the host; nothing if the participant does not hold the object.
    std::optional<ObjectPose> move(ObjectId object, const Pose& room_from_object, double scale,
                                   TimePoint now);

    // From the host. False if a change or the snapshot is missing: then request a snapshot.
    bool on_change(const ObjectChange& change);
    void on_snapshot(const ObjectsSnapshot& snapshot);
    // The host has decided on a request; its changes came before.
    void on_decision(std::uint32_t number);
    // Newest poses of the grips granted since the last call, to be sent again: poses overtake
    // requests, so the host may have ignored a pose whose grip it had not yet granted.
    std::vector<ObjectPose> take_poses_again();
    // The pose of an object that another participant holds. A pose that has overtaken the change
    // with its grip is kept until this change.
    void on_pose(const ObjectPose& pose);

    // The objects as the host decided; and changed by the requests that it has not decided on.
    const RoomObjects& confirmed() const { return objects_; }
    RoomObjects predicted() const;

private:
    Grip predicted_grip(ObjectId object) const;
    void take(ObjectId id, const RoomObject& decided);
    void forget_own_poses();
    bool apply(const ObjectPose& pose);

    ParticipantId self_{};
    bool has_snapshot_ = false;
    std::uint64_t revision_ = 0;
    RoomObjects objects_;
    std::map<ObjectId, ObjectPose> early_poses_;  // of grips that no change has contained yet
    std::uint32_t newest_request_ = 0;
    std::map<std::uint32_t, Request> undecided_;
    std::map<ObjectId, ObjectPose> own_poses_;  // the newest of each object held
    std::vector<ObjectPose> again_;
};

}  // namespace theatron::session
