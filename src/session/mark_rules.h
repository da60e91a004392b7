// SPDX-License-Identifier: Apache-2.0
// The host's decisions on marks (mark.h): how many there are, what they stick to, and that each one
// shows its real author.
//
// Pure functions.
#pragma once

#include <string_view>
#include <vector>

#include "session/room_object.h"

namespace theatron::session {

inline constexpr std::size_t max_marks = 512, max_marks_of_one = 128;
// Bytes of properties. The rest of what a room may have is kept for the case and other objects.
inline constexpr std::size_t max_mark_bytes = 1 << 17, max_mark_bytes_of_one = 3 << 14;

// Decides on a mark that `author` wants to make. Its colour and initials must be those of the
// author, its surface one of these objects, its place none of its own: points are in the frame of
// the surface. Gives a pin the lowest number that no other pin has.
Refusal judge_new_mark(const RoomObjects& objects, ParticipantId author, std::string_view name,
                       request::Create& mark);

// The marks of one author, or all.
std::vector<ObjectId> marks_of(const RoomObjects& objects, ParticipantId author, bool of_all);
// The marks whose organ or screen is not among the objects.
std::vector<ObjectId> marks_without_surface(const RoomObjects& objects);

}  // namespace theatron::session
