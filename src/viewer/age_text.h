// SPDX-License-Identifier: Apache-2.0
// The age of a picture or of a pose for people.
#pragma once

#include <optional>
#include <string>

namespace theatron::viewer {

// An older picture is marked as trouble.
inline constexpr double old_picture_ms = 500;
// A younger one is not told in the room: its figures would change all the time over what people
// look at.
inline constexpr double least_told_ms = 1000;

// "85 ms", "12 s", "3 min".
std::string age_text(double ms);

// For what is shown in the room: "85 ms", or a warning if it is not live: "NOT LIVE: 12 s old".
std::string seen_age(double ms, bool is_live);

// The title of a plain picture: "85 ms  left, colour", "NOT LIVE: 12 s old  left, colour". The age
// comes first, since a small picture cuts long titles. nullopt: it is not known.
std::string picture_title(const std::string& name, std::optional<double> age_ms, bool is_live);

}  // namespace theatron::viewer
