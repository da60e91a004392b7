// SPDX-License-Identifier: Apache-2.0
// A shared room as a participant knows it: the host's decisions, and before them what its own
// requests will most likely lead to.
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

    // A request to be sent to the host; its effect is part of predicted() at once. Returns its
    // number, which goes with it.
    std::uint32_t request(const Request& request);
    // The pose of an object that this participant holds, also if the host has not decided yet: to
    // be sent to the host. Nothing if it does not hold the object.
    std::optional<ObjectPose> move(ObjectId object, const Pose& room_from_object, double scale,
                                   TimePoint now);

    // From the host. A false result asks for a snapshot: a change is missing, or the snapshot is.
    bool on_change(const RoomChange& change);
    void on_snapshot(const RoomSnapshot& snapshot);
    // The host has decided on a request; its changes came before.
    void on_decision(std::uint32_t number);
    // Poses overtake requests, so the host may have ignored the newest pose of an object whose grip
    // it had not yet granted: poses of grips granted since the last call, to be sent again.
    std::vector<ObjectPose> take_poses_again();
    // Of an object that another participant holds. A pose that overtook the change which it belongs
    // to is kept until then.
    void on_pose(const ObjectPose& pose);

    // As the host decided, and the same with the requests that it has not decided on.
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
    std::map<ObjectId, ObjectPose> early_poses_;  // of grips that no change has told of yet
    std::uint32_t newest_request_ = 0;
    std::map<std::uint32_t, Request> undecided_;
    std::map<ObjectId, ObjectPose> own_poses_;  // the newest of each object held
    std::vector<ObjectPose> again_;
};

}  // namespace theatron::session
