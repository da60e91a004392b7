// SPDX-License-Identifier: Apache-2.0
// The participants' requests for changes of the room, and their refusals.
#include <algorithm>
#include <utility>
#include <variant>

#include "session/mark_rules.h"
#include "session/room_state.h"

namespace theatron::session {

RoomState::Decision RoomState::on_request(ParticipantId from, std::uint32_t number,
                                          const Request& request, bool may_change) {
    Decision decision;
    if (!may_change)
        decision.refusal = Refusal::role;
    else if (number == 0 || number >= given_grip)
        decision.refusal = Refusal::malformed;
    else
        decision.refusal =
            std::visit([&](const auto& wanted) { return apply(from, number, wanted); }, request);
    if (decision.refusal != Refusal::none)
        return decision;
    if (const auto* clear = std::get_if<request::ClearMarks>(&request))
        decision.changes = remove(marks_of(objects_, from, clear->of_all));
    else
        decision.changes.push_back(changed(touched_));
    return decision;
}

Refusal RoomState::apply(ParticipantId from, std::uint32_t, const request::Create& request) {
    if (!is_known(request.kind) || !is_sound(request.room_from_object, request.scale))
        return Refusal::malformed;
    if (request.kind == ObjectKind::person)
        return Refusal::role;
    const auto own = std::count_if(objects_.begin(), objects_.end(),
                                   [&](const auto& entry) { return entry.second.creator == from; });
    if (objects_.size() >= max_objects || std::size_t(own) >= max_objects_of_one ||
        !has_room_for(request.properties.size(), 0))
        return Refusal::too_many;
    touched_ = ObjectId(++newest_id_);
    objects_[touched_] = {request.kind,      from, {}, {}, request.room_from_object, request.scale,
                          request.properties};
    return Refusal::none;
}

Refusal RoomState::apply(ParticipantId from, std::uint32_t, const request::Remove& request) {
    const auto found = objects_.find(request.object);
    if (found == objects_.end())
        return Refusal::no_such_object;
    if (found->second.kind == ObjectKind::person)
        return Refusal::role;
    const ParticipantId holder = found->second.grip.holder;
    if (holder != ParticipantId{} && holder != from)
        return Refusal::held_by_another;
    objects_.erase(found);
    touched_ = request.object;
    return Refusal::none;
}

Refusal RoomState::apply(ParticipantId from, std::uint32_t number, const request::Grab& request) {
    const auto found = objects_.find(request.object);
    if (found == objects_.end() || found->second.kind == ObjectKind::person)
        return Refusal::no_such_object;
    RoomObject& object = found->second;
    if (object.grip.holder != ParticipantId{} && object.grip.holder != from)
        return Refusal::held_by_another;
    object.grip = {from, number};
    object.moved_at = {};
    touched_ = request.object;
    return Refusal::none;
}

std::pair<Refusal, RoomObject*> RoomState::find_held(ObjectId object, const Grip& grip) {
    const auto found = objects_.find(object);
    if (found == objects_.end())
        return {Refusal::no_such_object, nullptr};
    if (found->second.grip != grip)
        return {Refusal::not_held_by_you, nullptr};
    return {Refusal::none, &found->second};
}

Refusal RoomState::apply(ParticipantId from, std::uint32_t, const request::Release& request) {
    const auto [refusal, held] = find_held(request.object, {from, request.grip});
    if (!held)
        return refusal;
    RoomObject& object = *held;
    if (!may_be_at(object, request.room_from_object, request.scale))
        return Refusal::malformed;
    object.grip = {};
    object.room_from_object = request.room_from_object;
    object.scale = request.scale;
    touched_ = request.object;
    return Refusal::none;
}

Refusal RoomState::apply(ParticipantId from, std::uint32_t number,
                         const request::HandOver& request) {
    const auto [refusal, held] = find_held(request.object, {from, request.grip});
    if (!held)
        return refusal;
    RoomObject& object = *held;
    if (participants_.count(request.to) == 0)
        return Refusal::no_such_participant;
    // Somebody who gives an object to themselves may do so under the number by which another one
    // gave it to them: then the grip is the same, and so is its newest pose.
    const Grip given{request.to, number | given_grip};
    if (object.grip != given)
        object.moved_at = {};
    object.grip = given;
    touched_ = request.object;
    return Refusal::none;
}

Refusal RoomState::apply(ParticipantId, std::uint32_t, const request::SetProperties& request) {
    const auto found = objects_.find(request.object);
    if (found == objects_.end())
        return Refusal::no_such_object;
    RoomObject& object = found->second;
    if (object.kind == ObjectKind::person)
        return Refusal::role;
    if (!has_room_for(request.properties.size(), object.properties.size()))
        return Refusal::too_many;
    object.properties = request.properties;
    touched_ = request.object;
    return Refusal::none;
}

Refusal RoomState::apply(ParticipantId, std::uint32_t, const request::ClearMarks&) {
    return Refusal::none;
}

}  // namespace theatron::session
