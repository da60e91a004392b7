// SPDX-License-Identifier: Apache-2.0
// Reasons why the host refused a change of the room, for a person.
#pragma once

#include "session/room_object.h"

namespace theatron::viewer {

// Part of a sentence, without a full stop; empty where nothing was refused.
inline const char* text_of(session::Refusal refusal) {
    using session::Refusal;
    switch (refusal) {
        case Refusal::none:
            break;
        case Refusal::no_such_object:
            return "That object is gone";
        case Refusal::held_by_another:
            return "Somebody else holds this";
        case Refusal::not_held_by_you:
            return "You no longer hold this";
        case Refusal::role:
            return "Your role does not allow this";
        case Refusal::no_such_participant:
            return "That person has left";
        case Refusal::too_many:
            return "The room holds no more objects";
        case Refusal::malformed:
            return "The object would be out of the room's limits";
        case Refusal::too_often:
            return "That was too much at once; try again";
    }
    return "";
}

}  // namespace theatron::viewer
