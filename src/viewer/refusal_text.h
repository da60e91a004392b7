// SPDX-License-Identifier: Apache-2.0
// Reasons why the host refused a change of the room, for a person.
#pragma once

#include <string>

#include "session/room_object.h"
#include "wire/sentence.h"
#include "wire/text.h"

namespace theatron::viewer {

// The text of each reason has its number, counted from the first one.
constexpr wire::TextCode code_of(session::Refusal refusal) {
    return refusal == session::Refusal::none
               ? wire::TextCode::none
               : wire::TextCode(int(wire::TextCode::object_gone) - 1 + int(refusal));
}
static_assert(code_of(session::Refusal::no_such_object) == wire::TextCode::object_gone);
static_assert(code_of(session::Refusal::held_by_another) == wire::TextCode::held_by_another);
static_assert(code_of(session::Refusal::not_held_by_you) == wire::TextCode::not_held);
static_assert(code_of(session::Refusal::role) == wire::TextCode::role_forbids);
static_assert(code_of(session::Refusal::no_such_participant) == wire::TextCode::person_gone);
static_assert(code_of(session::Refusal::too_many) == wire::TextCode::room_full);
static_assert(code_of(session::Refusal::malformed) == wire::TextCode::beyond_room_limits);
static_assert(code_of(session::Refusal::too_often) == wire::TextCode::room_too_often);
static_assert(code_of(session::Refusal::recorded) == wire::TextCode::part_of_recording);
static_assert(code_of(session::Refusal::part_of_case) == wire::TextCode::part_of_case);
static_assert(code_of(session::Refusal::of_another) == wire::TextCode::of_another);
static_assert(code_of(session::Refusal::mark_stays) == wire::TextCode::mark_stays);
static_assert(code_of(session::Refusal::pinned) == wire::TextCode::screen_pinned);
static_assert(code_of(session::Refusal::of_sharer) == wire::TextCode::screen_of_another);

// Part of a sentence, without a full stop; empty where nothing was refused.
inline std::string text_of(session::Refusal refusal) {
    return wire::sentence({code_of(refusal)});
}

}  // namespace theatron::viewer
