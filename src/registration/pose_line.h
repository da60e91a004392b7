// SPDX-License-Identifier: Apache-2.0
// Lines with a pose, as tracking systems write them.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/vec.h"

namespace theatron::registration {

// Words of a line, between blanks, tabs or commas; more than `most` are not split.
std::vector<std::string_view> words_of(std::string_view line, std::size_t most);

// "X Y Z" or "X Y Z QW QX QY QZ": metres, and a rotation as a unit quaternion. Nothing for other
// words, for positions beyond a kilometre, and for rotations of another length.
std::optional<Pose> parse_pose(std::span<const std::string_view> words);

}  // namespace theatron::registration
