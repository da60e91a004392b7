// SPDX-License-Identifier: Apache-2.0
#include "session/member_room.h"

#include <utility>
#include <variant>

#include "session/room_state.h"
#include "session/room_track.h"

namespace theatron::session {
namespace {

// Refusals that wait for take_refusal(); further ones are dropped.
constexpr std::size_t kept_refusals = 64;
// Objects in one snapshot: all objects and those of a replay, and more people than a host can have.
constexpr std::size_t most_objects = RoomState::max_objects + 1024 + max_recorded_objects;

}  // namespace

void MemberRoom::begin(ParticipantId self) {
    const std::uint64_t version = version_;
    *this = MemberRoom();
    self_ = self;
    version_ = version + 1;
    replica_ = RoomReplica(self);
}

void MemberRoom::on_message(const wire::ToParticipant& message) {
    if (const auto* snapshot = std::get_if<wire::RoomSnapshot>(&message))
        on(*snapshot);
    else if (const auto* change = std::get_if<wire::RoomChange>(&message))
        on(*change);
    else if (const auto* decision = std::get_if<wire::RoomDecision>(&message))
        on(*decision);
    for (const ObjectPose& pose : replica_.take_poses_again())
        send_object_pose(pose);
}

void MemberRoom::on(const wire::RoomSnapshot& part) {
    if (part.part == 0) {
        gathered_ = {part.revision, {}, part.decided};
        next_part_ = 0;
    }
    if (part.part != next_part_ || part.part >= part.parts || part.revision != gathered_.revision)
        return;
    auto objects = decode_objects(part.objects, most_objects);
    if (!objects || gathered_.objects.size() + objects->size() > most_objects)
        return;
    gathered_.objects.merge(*objects);
    if (++next_part_ != part.parts)
        return;
    replica_.on_snapshot(gathered_);
    gathered_ = {};
    next_part_ = 0;
    known_ = true;
    asked_for_snapshot_ = false;
    ++version_;
}

void MemberRoom::on(const wire::RoomChange& message) {
    ObjectChange change{message.revision, ObjectId(message.object), std::nullopt};
    if (!message.now.empty()) {
        const auto decoded = decode_objects(message.now, 1);
        if (!decoded || decoded->size() != 1 || decoded->begin()->first != change.object)
            return;
        change.now = decoded->begin()->second;
    }
    if (known_ && !replica_.on_change(change) && !std::exchange(asked_for_snapshot_, true))
        requests_.push_back({});
    ++version_;
}

void MemberRoom::on(const wire::RoomDecision& decision) {
    if (!known_)
        return;
    replica_.on_decision(decision.number);
    if (decision.refusal != 0 && refusals_.size() < kept_refusals)
        refusals_.emplace_back(decision.number, Refusal(decision.refusal));
    ++version_;
}

void MemberRoom::on_pose(ObjectId object, ByteView body) {
    const auto pose = decode_object_pose(object, body);
    if (!pose || !known_)
        return;
    replica_.on_pose(*pose);
    ++version_;
}

std::uint32_t MemberRoom::ask(const Request& request) {
    if (!known_)
        return 0;
    const std::uint32_t number = replica_.request(request);
    requests_.push_back({number, encode_request(request)});
    ++version_;
    return number;
}

bool MemberRoom::move(ObjectId object, const Pose& room_from_object, double scale, TimePoint now) {
    if (!known_)
        return false;
    const auto pose = replica_.move(object, room_from_object, scale, now);
    if (!pose)
        return false;
    send_object_pose(*pose);
    ++version_;
    return true;
}

void MemberRoom::send_object_pose(const ObjectPose& pose) {
    poses_[pose.object] = encode_object_pose(pose);
}

std::vector<wire::RoomRequest> MemberRoom::take_requests() {
    return std::exchange(requests_, {});
}

std::map<ObjectId, Bytes> MemberRoom::take_poses() {
    return std::exchange(poses_, {});
}

std::optional<std::pair<std::uint32_t, Refusal>> MemberRoom::take_refusal() {
    if (refusals_.empty())
        return std::nullopt;
    const auto refusal = refusals_.front();
    refusals_.pop_front();
    return refusal;
}

}  // namespace theatron::session
