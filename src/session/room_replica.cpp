// SPDX-License-Identifier: Apache-2.0
#include "session/room_replica.h"

#include <type_traits>
#include <utility>

#include "session/room_state.h"

namespace theatron::session {
namespace {

// Early poses: at most one for each object that a host can have.
constexpr std::size_t max_early_poses = RoomState::max_objects;

// Applies a request that the host will probably accept. A created object appears when the host
// has assigned its id.
void predict(RoomObjects& objects, ParticipantId self, std::uint32_t number,
             const Request& request) {
    std::visit(
        [&](const auto& wanted) {
            using Wanted = std::decay_t<decltype(wanted)>;
            if constexpr (std::is_same_v<Wanted, request::ClearMarks>) {
                std::erase_if(objects, [&](const auto& entry) {
                    return entry.second.kind == ObjectKind::mark && !is_recorded(entry.first) &&
                           (wanted.of_all || entry.second.creator == self);
                });
            } else if constexpr (!std::is_same_v<Wanted, request::Create>) {
                const auto found = objects.find(wanted.object);
                if (found == objects.end())
                    return;
                RoomObject& object = found->second;
                if constexpr (std::is_same_v<Wanted, request::Remove>) {
                    if (object.grip.holder == ParticipantId{} || object.grip.holder == self)
                        objects.erase(found);
                } else if constexpr (std::is_same_v<Wanted, request::Grab>) {
                    if (object.grip.holder == ParticipantId{} || object.grip.holder == self)
                        object.grip = {self, number};
                } else if constexpr (std::is_same_v<Wanted, request::Release>) {
                    if (object.grip != Grip{self, wanted.grip})
                        return;
                    object.grip = {};
                    object.room_from_object = wanted.room_from_object;
                    object.scale = wanted.scale;
                } else if constexpr (std::is_same_v<Wanted, request::HandOver>) {
                    if (object.grip == Grip{self, wanted.grip})
                        object.grip = {wanted.to, number | given_grip};
                } else {
                    object.properties = wanted.properties;
                }
            }
        },
        request);
}

}  // namespace

std::uint32_t RoomReplica::request(const Request& request) {
    undecided_[++newest_request_] = request;
    return newest_request_;
}

Grip RoomReplica::predicted_grip(ObjectId object) const {
    const auto found = objects_.find(object);
    if (found == objects_.end())
        return {};
    RoomObjects one{*found};
    for (const auto& [number, request] : undecided_)
        predict(one, self_, number, request);
    return one.empty() ? Grip{} : one.begin()->second.grip;
}

std::optional<ObjectPose> RoomReplica::move(ObjectId object, const Pose& room_from_object,
                                            double scale, TimePoint now) {
    const Grip grip = predicted_grip(object);
    if (grip.holder != self_ || grip.number == 0)
        return std::nullopt;
    ObjectPose& pose = own_poses_[object];
    // Each pose of a grip needs its own time, because only a later one replaces it.
    const bool same_grip = pose.grip == grip;
    const TimePoint at = same_grip && now <= pose.at ? pose.at + Duration(1) : now;
    pose = {object, grip, at, room_from_object, scale};
    (void)apply(pose);
    return pose;
}

bool RoomReplica::on_change(const ObjectChange& change) {
    if (!has_snapshot_)
        return false;
    if (change.revision <= revision_)
        return true;
    if (change.revision != revision_ + 1) {
        has_snapshot_ = false;
        return false;
    }
    revision_ = change.revision;
    if (change.now) {
        take(change.object, *change.now);
    } else {
        objects_.erase(change.object);
        early_poses_.erase(change.object);
    }
    return true;
}

// Poses are sent apart from changes: a known pose may be newer than that of the change.
void RoomReplica::take(ObjectId id, const RoomObject& decided) {
    RoomObject& object = objects_[id];
    const RoomObject before = std::exchange(object, decided);
    const bool is_held = decided.grip.holder != ParticipantId{};
    if (is_held && before.grip == decided.grip && before.moved_at > decided.moved_at) {
        object.moved_at = before.moved_at;
        object.room_from_object = before.room_from_object;
        object.scale = before.scale;
    }
    if (const auto early = early_poses_.find(id);
        early != early_poses_.end() && apply(early->second))
        early_poses_.erase(early);
    const auto own = own_poses_.find(id);
    if (own != own_poses_.end() && apply(own->second) && before.grip != decided.grip)
        again_.push_back(own->second);
}

bool RoomReplica::apply(const ObjectPose& pose) {
    const auto found = objects_.find(pose.object);
    if (found == objects_.end() || found->second.grip != pose.grip)
        return false;
    RoomObject& object = found->second;
    if (pose.at > object.moved_at) {
        object.moved_at = pose.at;
        object.room_from_object = pose.room_from_object;
        object.scale = pose.scale;
    }
    return true;
}

void RoomReplica::on_snapshot(const ObjectsSnapshot& snapshot) {
    has_snapshot_ = true;
    revision_ = snapshot.revision;
    std::erase_if(objects_,
                  [&](const auto& entry) { return snapshot.objects.count(entry.first) == 0; });
    for (const auto& [id, object] : snapshot.objects)
        take(id, object);
    undecided_.erase(undecided_.begin(), undecided_.upper_bound(snapshot.decided));
    forget_own_poses();
}

void RoomReplica::on_decision(std::uint32_t number) {
    undecided_.erase(number);
    forget_own_poses();
}

// Drops poses of grips that have ended. While a request is undecided, its grip may still begin.
void RoomReplica::forget_own_poses() {
    if (undecided_.empty())
        std::erase_if(own_poses_, [&](const auto& entry) {
            const auto found = objects_.find(entry.first);
            return found == objects_.end() || found->second.grip != entry.second.grip;
        });
}

std::vector<ObjectPose> RoomReplica::take_poses_again() {
    return std::exchange(again_, {});
}

void RoomReplica::on_pose(const ObjectPose& pose) {
    if (!apply(pose) && (early_poses_.size() < max_early_poses || early_poses_.count(pose.object)))
        early_poses_[pose.object] = pose;
}

RoomObjects RoomReplica::predicted() const {
    RoomObjects objects = objects_;
    for (const auto& [number, request] : undecided_)
        predict(objects, self_, number, request);
    for (const auto& [id, pose] : own_poses_)
        if (const auto found = objects.find(id);
            found != objects.end() && found->second.grip == pose.grip) {
            found->second.room_from_object = pose.room_from_object;
            found->second.scale = pose.scale;
        }
    return objects;
}

}  // namespace theatron::session
