// SPDX-License-Identifier: Apache-2.0
#include "session/host_room.h"

#include <utility>

namespace theatron::session {

void HostRoom::join(ParticipantId id, const PersonFacts& facts, bool keeps_room) {
    tell(state_.on_joined(id, encode_person(facts)));
    members_[id].keeps_room = keeps_room;
    if (keeps_room)
        send_snapshot(id);
}

void HostRoom::leave(ParticipantId id) {
    if (members_.erase(id) == 0)
        return;
    for (const RoomChange& change : state_.on_left(id))
        tell(change);
}

void HostRoom::on_request(ParticipantId id, const wire::RoomRequest& message) {
    const auto member = members_.find(id);
    if (member == members_.end() || !member->second.keeps_room)
        return;
    if (message.number == 0)
        return send_snapshot(id);
    const auto request = decode_request(message.request);
    RoomState::Decision decision{Refusal::malformed, {}};
    if (request)
        decision = state_.on_request(id, message.number, *request, true);
    for (const RoomChange& change : decision.changes)
        tell(change);
    member->second.decided = message.number;
    send(id, wire::RoomDecision{message.number, std::uint8_t(decision.refusal)});
}

void HostRoom::refuse(ParticipantId id, const wire::RoomRequest& message) {
    const auto member = members_.find(id);
    if (member == members_.end() || message.number == 0)
        return;
    member->second.decided = message.number;
    send(id, wire::RoomDecision{message.number, std::uint8_t(Refusal::too_often)});
}

void HostRoom::send_snapshot(ParticipantId id) {
    const auto member = members_.find(id);
    if (member == members_.end() || !member->second.keeps_room)
        return;
    std::vector<Bytes> parts(1);
    Bytes one;
    for (const auto& [object, facts] : state_.objects()) {
        one.clear();
        append_object(object, facts, one);
        if (parts.back().size() + one.size() > wire::max_room_part_size)
            parts.emplace_back();
        parts.back().insert(parts.back().end(), one.begin(), one.end());
    }
    for (std::size_t part = 0; part < parts.size(); ++part)
        send(id,
             wire::RoomSnapshot{state_.revision(), std::uint16_t(part), std::uint16_t(parts.size()),
                                std::move(parts[part]), member->second.decided});
}

HostRoom::Forward HostRoom::on_pose(ParticipantId id, const wire::State& state, TimePoint now) {
    const auto member = members_.find(id);
    if (member == members_.end())
        return {};
    if (!member->second.poses.take(now))
        return {{}, true};
    const auto pose = decode_object_pose(ObjectId(state.key.id), state.body);
    if (!pose || pose->at > now + max_pose_lead || !state_.on_pose(id, *pose))
        return {};
    Forward forward;
    for (const auto& [other, facts] : members_)
        if (other != id && facts.keeps_room)
            forward.receivers.push_back(other);
    return forward;
}

void HostRoom::tell(const RoomChange& change) {
    wire::RoomChange message{change.revision, std::uint32_t(change.object), {}};
    if (change.now)
        append_object(change.object, *change.now, message.now);
    for (const auto& [id, member] : members_)
        if (member.keeps_room)
            send(id, message);
}

}  // namespace theatron::session
