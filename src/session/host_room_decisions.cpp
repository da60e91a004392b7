// SPDX-License-Identifier: Apache-2.0
// The decisions of a HostRoom on requests that concern a case or marks.
#include <algorithm>
#include <iterator>
#include <utility>

#include "session/host_room.h"
#include "session/mark_rules.h"

namespace theatron::session {

// Objects that people make.

namespace {

bool is_made_by_hand(ObjectKind kind) {
    return kind == ObjectKind::brick || kind == ObjectKind::mark;
}

}  // namespace

Refusal HostRoom::judge_place_for(ParticipantId id, const Request& request) const {
    const auto* create = std::get_if<request::Create>(&request);
    if (!create || !is_made_by_hand(create->kind))
        return Refusal::none;
    const Member& member = members_.at(id);
    const bool manages = may(member.role, Right::manage);
    const auto of_person = std::count_if(authors_.begin(), authors_.end(), [&](const auto& one) {
        return one.second == member.person && state_.objects().contains(one.first);
    });
    const auto by_link = std::count_if(links_.begin(), links_.end(), [&](const auto& one) {
        return !one.second.empty() && one.second == member.link &&
               state_.objects().contains(one.first);
    });
    const std::size_t places = RoomState::max_objects - (manages ? 0 : kept_objects);
    const bool is_full = state_.objects().size() >= places ||
                         std::size_t(of_person) >= RoomState::max_objects_of_one ||
                         (!manages && std::size_t(by_link) >= max_objects_by_one_link);
    return is_full ? Refusal::too_many : Refusal::none;
}

void HostRoom::note_author(ParticipantId id, const Request& request,
                           const RoomState::Decision& decision) {
    const auto* create = std::get_if<request::Create>(&request);
    if (!create || !is_made_by_hand(create->kind) || decision.refusal != Refusal::none)
        return;
    const Member& member = members_.at(id);
    const ObjectId made = decision.changes.front().object;
    links_[made] = member.link;
    if (!member.person.empty())
        authors_[made] = member.person;
}

std::size_t HostRoom::clear_of(ParticipantId id) {
    const auto person_in = [](const Authors& authors, ObjectId object) {
        const auto found = authors.find(object);
        return found == authors.end() ? Bytes() : found->second;
    };
    const auto author_of = [&](ObjectId object) {
        const Bytes author = person_in(authors_, object);
        return author.empty() ? person_in(sharers_, object) : author;
    };
    // Somebody who has left is known by what stayed here.
    Bytes person;
    if (const auto member = members_.find(id); member != members_.end())
        person = member->second.person;
    for (const auto& [object, facts] : state_.objects())
        if (person.empty() && id != ParticipantId{} && facts.creator == id)
            person = author_of(object);
    std::vector<ObjectId> made;
    for (const auto& [object, facts] : state_.objects()) {
        const auto screen = decode_shared_screen(facts.kind, facts.properties);
        const bool may_go = is_made_by_hand(facts.kind) || (screen && !screen->camera);
        const Bytes author = author_of(object);
        if (may_go && (facts.creator == id || (!person.empty() && author == person)))
            made.push_back(object);
    }
    for (const ObjectChange& change : state_.remove(made))
        tell(change);
    return made.size();
}

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
        for (ObjectChange& change : state_.replace_case(id, {}).changes)
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

std::vector<ObjectChange> HostRoom::end_presenting(std::optional<ParticipantId> presenter) {
    std::vector<ObjectChange> changes;
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
        return state_.on_request(id, number, mark, true);
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
