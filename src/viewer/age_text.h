// SPDX-License-Identifier: Apache-2.0
// The age of a picture or of a pose for people.
#pragma once

#include <optional>
#include <string>

namespace theatron::viewer {

// An older picture is marked as trouble.
inline constexpr double old_picture_ms = 500;

// "85 ms", "12 s", "3 min".
std::string age_text(double ms);

// For what is shown in the room: "85 ms", or a warning if it is not live: "NOT LIVE: 12 s old".
std::string seen_age(double ms, bool is_live);

// The title of a plain picture: "camera left, colour  85 ms", "camera left, colour  NOT LIVE: 12 s
// old". nullopt: the age is not known.
std::string picture_title(const std::string& name, std::optional<double> age_ms, bool is_live);

}  // namespace theatron::viewer
