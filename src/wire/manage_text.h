// SPDX-License-Identifier: Apache-2.0
// Reasons why the host refused a decision on a person, for the operator.
#pragma once

#include <string>

#include "wire/control.h"
#include "wire/sentence.h"
#include "wire/text.h"

namespace theatron::wire {

// The text of each reason has its number, counted from the first one.
constexpr TextCode code_of(ManageRefusal refusal) {
    return refusal == ManageRefusal::none
               ? TextCode::none
               : TextCode(int(TextCode::operators_decide) - 1 + int(refusal));
}
static_assert(code_of(ManageRefusal::role) == TextCode::operators_decide);
static_assert(code_of(ManageRefusal::no_such_participant) == TextCode::decided_person_gone);
static_assert(code_of(ManageRefusal::not_waiting) == TextCode::person_is_in);
static_assert(code_of(ManageRefusal::still_waiting) == TextCode::person_waits);
static_assert(code_of(ManageRefusal::yourself) == TextCode::not_on_yourself);
static_assert(code_of(ManageRefusal::too_often) == TextCode::decided_too_often);
static_assert(code_of(ManageRefusal::no_such_camera) == TextCode::adjusted_camera_gone);
static_assert(code_of(ManageRefusal::beyond_limits) == TextCode::beyond_adjustment);
static_assert(code_of(ManageRefusal::adjusting_role) == TextCode::operators_adjust);
static_assert(code_of(ManageRefusal::playing_role) == TextCode::role_plays_not);
static_assert(code_of(ManageRefusal::nothing_to_play) == TextCode::nothing_to_play);
static_assert(code_of(ManageRefusal::nothing_kept) == TextCode::nothing_kept);
static_assert(code_of(ManageRefusal::shows_no_study) == TextCode::shows_no_study);
static_assert(code_of(ManageRefusal::other_study) == TextCode::other_study);
static_assert(code_of(ManageRefusal::no_such_codec) == TextCode::condition_codec);
static_assert(code_of(ManageRefusal::large_step) == TextCode::large_step);
static_assert(code_of(ManageRefusal::draws_flat) == TextCode::draws_flat);
static_assert(last_manage_refusal == ManageRefusal::draws_flat);

// A sentence, in the language of the program's person; empty for `none`.
inline std::string text_of(ManageRefusal refusal) {
    return sentence({code_of(refusal)});
}

}  // namespace theatron::wire
