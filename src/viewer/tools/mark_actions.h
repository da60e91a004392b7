// SPDX-License-Identifier: Apache-2.0
// Marks that a person makes and removes: each function sends requests to the host. False if there
// is nothing to do, or if the room is not known yet.
#pragma once

#include "client/participant.h"
#include "session/mark.h"

namespace theatron::viewer {

// Gives the mark its author's colour and initials; a pin gets its number from the host. A stroke of
// too many points is simplified.
bool make_mark(client::Participant& participant, session::Mark mark);
// The same mark before the host has it: signed and simplified. Nullopt without a room.
std::optional<session::Mark> preview_of(const client::Participant::Room& room, session::Mark mark);

// Removes the newest mark that this person made.
bool undo_mark(client::Participant& participant);
// Removes all marks of this person; for operators also those of all.
bool clear_marks(client::Participant& participant, bool of_all);

}  // namespace theatron::viewer
