// SPDX-License-Identifier: Apache-2.0
#include "session/host_room.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

namespace {

bool names_recorded(const Request& request) {
    return std::visit(
        [](const auto& wanted) {
            if constexpr (requires { wanted.object; })
                return is_recorded(wanted.object);
            return false;
        },
        request);
}

}  // namespace

void HostRoom::join(ParticipantId id, const PersonFacts& facts, bool keeps_room, TimePoint now,
                    const Bytes& person, const std::string& link) {
    tell(state_.on_joined(id, encode_person(facts), now));
    Member& member = members_[id];
    member.keeps_room = keeps_room;
    member.role = facts.role;
    member.name = facts.name;
    member.person = person;
    member.link = link;
    const auto is_gone = [&](const auto& one) { return !state_.objects().contains(one.first); };
    std::erase_if(authors_, is_gone);
    std::erase_if(sharers_, is_gone);
    std::erase_if(links_, is_gone);
    std::vector<ObjectId> own;
    for (const auto& [object, author] : authors_)
        if (author == person && state_.objects().at(object).kind == ObjectKind::mark)
            own.push_back(object);
    for (const ObjectChange& change : state_.set_creator(own, id))
        tell(change);
    take_own_screens(id);
    if (keeps_room)
        send_snapshot(id);
}

void HostRoom::watch(ParticipantId id) {
    Member& member = members_[id];
    member.keeps_room = member.watches = true;
    member.role = Role::observer;
    send_snapshot(id);
}

HostRoom::Authors HostRoom::authors() const {
    Authors all = authors_;
    all.insert(sharers_.begin(), sharers_.end());
    return all;
}

void HostRoom::set_person(ParticipantId id, const PersonFacts& facts) {
    const auto member = members_.find(id);
    if (member == members_.end() || member->second.watches)
        return;
    member->second.role = facts.role;
    member->second.name = facts.name;
    if (!may(facts.role, Right::handle)) {
        for (const ObjectChange& change : state_.release_all(id))
            tell(change);
        for (const ObjectChange& change : end_presenting(id))
            tell(change);
    }
    for (const ObjectChange& change : state_.on_person(id, encode_person(facts)))
        tell(change);
}

bool HostRoom::gives_to_observer(const Request& request) const {
    const auto* gift = std::get_if<request::HandOver>(&request);
    const auto receiver = gift ? members_.find(gift->to) : members_.end();
    return receiver != members_.end() && !may(receiver->second.role, Right::handle);
}

void HostRoom::leave(ParticipantId id) {
    if (members_.erase(id) == 0)
        return;
    for (const ObjectChange& change : end_presenting(id))
        tell(change);
    for (const ObjectChange& change : state_.on_left(id))
        tell(change);
}

void HostRoom::clear() {
    for (const ObjectChange& change : state_.clear())
        tell(change);
}

std::optional<CameraId> HostRoom::on_request(ParticipantId id, const wire::RoomRequest& message) {
    const auto member = members_.find(id);
    if (member == members_.end() || !member->second.keeps_room)
        return std::nullopt;
    if (message.number == 0) {
        send_snapshot(id);
        return std::nullopt;
    }
    const auto request = decode_request(message.request);
    RoomState::Decision decision{Refusal::malformed, {}};
    const std::optional<CameraId> camera = request ? camera_of_removed(*request) : std::nullopt;
    if (request && names_recorded(*request))
        decision.refusal = Refusal::recorded;
    else if (request && (gives_to_observer(*request) || !may(member->second.role, Right::handle)))
        decision.refusal = Refusal::role;
    else if (const Refusal full = request ? judge_place_for(id, *request) : Refusal::none;
             full != Refusal::none)
        decision.refusal = full;
    else if (auto on_screen = request ? decide_on_screen(id, *request) : std::nullopt)
        decision = std::move(*on_screen);
    else if (auto on_case = request ? decide_on_case(id, message.number, *request) : std::nullopt)
        decision = std::move(*on_case);
    else if (auto on_mark = request ? decide_on_mark(id, message.number, *request) : std::nullopt)
        decision = std::move(*on_mark);
    else if (request)
        decision = state_.on_request(id, message.number, *request, true);
    if (request)
        note_author(id, *request, decision);
    for (const ObjectChange& change : decision.changes)
        tell(change);
    member->second.decided = message.number;
    send(id, wire::RoomDecision{message.number, std::uint8_t(decision.refusal)});
    return decision.refusal == Refusal::none ? camera : std::nullopt;
}

void HostRoom::refuse(ParticipantId id, const wire::RoomRequest& message, Refusal refusal) {
    const auto member = members_.find(id);
    if (member == members_.end() || message.number == 0)
        return;
    member->second.decided = message.number;
    send(id, wire::RoomDecision{message.number, std::uint8_t(refusal)});
}

void HostRoom::send_snapshot(ParticipantId id) {
    const auto member = members_.find(id);
    if (member == members_.end() || !member->second.keeps_room)
        return;
    std::vector<Bytes> parts(1);
    Bytes one;
    for (const RoomObjects* objects : {&state_.objects(), &replayed_.objects()})
        for (const auto& [object, facts] : *objects) {
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

std::vector<ParticipantId> HostRoom::receivers() const {
    std::vector<ParticipantId> all;
    for (const auto& [id, member] : members_)
        if (member.keeps_room)
            all.push_back(id);
    return all;
}

std::vector<ObjectPose> HostRoom::replay(const RoomObjects& recorded, TimePoint now) {
    ReplayedRoom::Step step = replayed_.show(recorded, now);
    for (auto& [id, object] : step.changes) {
        ++replayed_changes_;
        tell({state_.take_revision(), id, std::move(object)});
    }
    return std::move(step.moved);
}

void HostRoom::tell(const ObjectChange& change) {
    wire::RoomChange message{change.revision, std::uint32_t(change.object), {}};
    if (change.now)
        append_object(change.object, *change.now, message.now);
    for (const auto& [id, member] : members_)
        if (member.keeps_room)
            send(id, message);
}

}  // namespace theatron::session
