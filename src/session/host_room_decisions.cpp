// SPDX-License-Identifier: Apache-2.0
// The decisions of a HostRoom on requests that concern a case or marks.
#include <algorithm>
#include <iterator>
#include <utility>

#include "session/host_room.h"
#include "session/mark_rules.h"

namespace theatron::session {

// Cases.

std::optional<ContentHash> HostRoom::open_case() const {
    for (const auto& [id, object] : state_.objects())
        if (const auto organ = decode_as<CaseOrgan>(object.kind, object.properties))
            return organ->of_case;
    return std::nullopt;
}

std::set<ContentHash> HostRoom::shown_cases() const {
    std::set<ContentHash> shown;
    for (const RoomObjects* objects : {&state_.objects(), &replayed_.objects()})
        for (const auto& [id, object] : *objects)
            if (const auto organ = decode_as<CaseOrgan>(object.kind, object.properties))
                shown.insert(organ->of_case);
    return shown;
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

// Marks.

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

}  // namespace theatron::session
