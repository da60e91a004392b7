// SPDX-License-Identifier: Apache-2.0
#include "session/host_room.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "session/mark_rules.h"

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
                    const Bytes& person) {
    tell(state_.on_joined(id, encode_person(facts), now));
    Member& member = members_[id];
    member.keeps_room = keeps_room;
    member.role = facts.role;
    member.name = facts.name;
    member.person = person;
    const auto is_gone = [&](const auto& one) { return !state_.objects().contains(one.first); };
    std::erase_if(authors_, is_gone);
    std::erase_if(sharers_, is_gone);
    std::vector<ObjectId> own;
    for (const auto& [mark, author] : authors_)
        if (author == person)
            own.push_back(mark);
    for (const RoomChange& change : state_.set_creator(own, id))
        tell(change);
    take_own_screens(id);
    if (keeps_room)
        send_snapshot(id);
}

HostRoom::Authors HostRoom::authors() const {
    Authors all = authors_;
    all.insert(sharers_.begin(), sharers_.end());
    return all;
}

void HostRoom::set_person(ParticipantId id, const PersonFacts& facts) {
    const auto member = members_.find(id);
    if (member == members_.end())
        return;
    member->second.role = facts.role;
    member->second.name = facts.name;
    if (!may(facts.role, Right::handle)) {
        for (const RoomChange& change : state_.release_all(id))
            tell(change);
        for (const RoomChange& change : end_presenting(id))
            tell(change);
    }
    for (const RoomChange& change : state_.on_person(id, encode_person(facts)))
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
    for (const RoomChange& change : end_presenting(id))
        tell(change);
    for (const RoomChange& change : state_.on_left(id))
        tell(change);
}

void HostRoom::clear() {
    for (const RoomChange& change : state_.clear())
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
    else if (auto on_screen = request ? decide_on_screen(id, *request) : std::nullopt)
        decision = std::move(*on_screen);
    else if (auto on_case = request ? decide_on_case(id, message.number, *request) : std::nullopt)
        decision = std::move(*on_case);
    else if (auto on_mark = request ? decide_on_mark(id, message.number, *request) : std::nullopt)
        decision = std::move(*on_mark);
    else if (request)
        decision = state_.on_request(id, message.number, *request, true);
    for (const RoomChange& change : decision.changes)
        tell(change);
    member->second.decided = message.number;
    send(id, wire::RoomDecision{message.number, std::uint8_t(decision.refusal)});
    return decision.refusal == Refusal::none ? camera : std::nullopt;
}

std::optional<ContentHash> HostRoom::open_case() const {
    for (const auto& [id, object] : state_.objects())
        if (const auto organ = decode_as<CaseOrgan>(object.kind, object.properties))
            return organ->of_case;
    return std::nullopt;
}

std::optional<RoomState::Decision> HostRoom::decide_on_case(ParticipantId id, std::uint32_t number,
                                                            const Request& request) {
    const auto is_of_case = [](ObjectKind kind) {
        return kind == ObjectKind::organ || kind == ObjectKind::screen;
    };
    const auto find = [&](ObjectId object) -> const RoomObject* {
        const auto found = state_.objects().find(object);
        return found != state_.objects().end() && is_of_case(found->second.kind) &&
                       !is_shared_screen(found->second)
                   ? &found->second
                   : nullptr;
    };
    if (const auto* create = std::get_if<request::Create>(&request))
        return is_of_case(create->kind) ? std::optional(open_case(id, *create)) : std::nullopt;
    if (const auto* change = std::get_if<request::SetProperties>(&request)) {
        const RoomObject* object = find(change->object);
        if (object && !may_become(object->kind, object->properties, change->properties))
            return RoomState::Decision{Refusal::malformed, {}};
        const auto screen = [&](const Bytes& properties) {
            return decode_as<CaseScreen>(ObjectKind::screen, properties);
        };
        const bool manages = may(members_.at(id).role, Right::manage);
        if (object && object->kind == ObjectKind::screen &&
            !may_change(id, manages, *screen(object->properties), *screen(change->properties)))
            return RoomState::Decision{Refusal::held_by_another, {}};
    }
    const auto* remove = std::get_if<request::Remove>(&request);
    const RoomObject* removed = remove ? find(remove->object) : nullptr;
    if (!removed)
        return std::nullopt;
    // A part is hidden, not removed. Without the organ there is no case.
    if (!decode_as<CaseOrgan>(removed->kind, removed->properties))
        return RoomState::Decision{Refusal::part_of_case, {}};
    RoomState::Decision decision = state_.on_request(id, number, request, true);
    if (decision.refusal == Refusal::none)
        for (RoomChange& change : state_.replace_case(id, {}).changes)
            decision.changes.push_back(std::move(change));
    return decision;
}

std::optional<RoomState::Decision> HostRoom::decide_on_mark(ParticipantId id, std::uint32_t number,
                                                            const Request& request) {
    const Member& member = members_.at(id);
    const bool decides_on_others = may(member.role, Right::manage);
    if (const auto* create = std::get_if<request::Create>(&request)) {
        if (create->kind != ObjectKind::mark)
            return std::nullopt;
        request::Create mark = *create;
        const Refusal refusal = judge_new_mark(state_.objects(), id, member.name, mark);
        if (refusal != Refusal::none)
            return RoomState::Decision{refusal, {}};
        RoomState::Decision decision = state_.on_request(id, number, mark, true);
        if (decision.refusal == Refusal::none && !member.person.empty())
            authors_[decision.changes.front().object] = member.person;
        return decision;
    }
    if (const auto* clear = std::get_if<request::ClearMarks>(&request))
        return clear->of_all && !decides_on_others
                   ? std::optional(RoomState::Decision{Refusal::role, {}})
                   : std::nullopt;
    const auto named = std::visit(
        [](const auto& wanted) {
            if constexpr (requires { wanted.object; })
                return wanted.object;
            return ObjectId{};
        },
        request);
    const auto found = state_.objects().find(named);
    if (found == state_.objects().end() || found->second.kind != ObjectKind::mark)
        return std::nullopt;
    if (!std::holds_alternative<request::Remove>(request))
        return RoomState::Decision{Refusal::mark_stays, {}};
    if (found->second.creator != id && !decides_on_others)
        return RoomState::Decision{Refusal::of_another, {}};
    return std::nullopt;
}

std::vector<RoomChange> HostRoom::end_presenting(std::optional<ParticipantId> presenter) {
    std::vector<RoomChange> changes;
    const RoomObjects objects = state_.objects();
    for (const auto& [id, object] : objects) {
        auto screen = decode_as<CaseScreen>(object.kind, object.properties);
        if (!screen || screen->presenter == ParticipantId{} ||
            screen->presenter != presenter.value_or(screen->presenter))
            continue;
        screen->presenter = {};
        auto decision =
            state_.on_request({}, 1, request::SetProperties{id, encode_case_object(*screen)}, true);
        std::move(decision.changes.begin(), decision.changes.end(), std::back_inserter(changes));
    }
    return changes;
}

RoomState::Decision HostRoom::open_case(ParticipantId id, const request::Create& request) {
    const auto organ = decode_as<CaseOrgan>(request.kind, request.properties);
    if (!organ)
        return {Refusal::malformed, {}};
    const auto facts = std::find_if(cases_.begin(), cases_.end(), [&](const CaseFacts& known) {
        return known.id == organ->of_case;
    });
    if (facts == cases_.end())
        return {Refusal::no_such_object, {}};
    return state_.replace_case(id, case_objects(*facts, request.room_from_object));
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
    for (const RoomObjects* objects : {&state_.objects(), &std::as_const(replayed_)})
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
    const RoomObjects next = as_replayed(recorded);
    const auto change = [&](ObjectId id, std::optional<RoomObject> object) {
        ++replayed_changes_;
        tell({state_.take_revision(), id, std::move(object)});
    };
    for (auto entry = replayed_.begin(); entry != replayed_.end();) {
        const ObjectId id = entry->first;
        if (next.contains(id)) {
            ++entry;
            continue;
        }
        entry = replayed_.erase(entry);
        change(id, std::nullopt);
    }
    std::vector<ObjectPose> moved;
    for (const auto& [id, object] : next) {
        const auto [known, is_new] = replayed_.try_emplace(id, object);
        RoomObject& before = known->second;
        RoomObject after = object;
        after.moved_at = before.moved_at;
        if (!is_new && before == after)
            continue;
        const bool only_moves = !is_new && after.grip.holder != ParticipantId{} &&
                                after.grip == before.grip && after.kind == before.kind &&
                                after.creator == before.creator &&
                                after.properties == before.properties;
        // Receivers take only poses that are newer than the one before.
        after.moved_at = is_new ? now : std::max(now, before.moved_at + Duration(1));
        before = after;
        if (only_moves)
            moved.push_back({id, after.grip, after.moved_at, after.room_from_object, after.scale});
        else
            change(id, std::move(after));
    }
    return moved;
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
