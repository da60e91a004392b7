// SPDX-License-Identifier: Apache-2.0
// The files of a folder of pictures: their order, and which colour belongs to which depth
// (docs/formats/camera_folder.md). Names alone; no picture is read, except by folder_frames().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::capture {

// An order of all texts in which numbers count by their value: 2, 02, 9, 10, 10a.
bool precedes_naturally(const std::string& a, const std::string& b);

// The time that a file's name states (without its ending): seconds with a fraction, or
// milliseconds, microseconds or nanoseconds since 1970, told apart by their number of digits.
std::optional<Duration> time_in_name(const std::string& stem);

// The files of one frame. `color` may be empty.
struct FramePaths {
    std::filesystem::path depth;
    std::filesystem::path color;
};

struct PairedFrames {
    std::vector<FramePaths> frames;  // one for each depth file
    std::size_t without_color = 0, unused_colors = 0;
};

// Pairs files in their order. A colour belongs to the depth of the same name; if no name is the
// same, of the same number in its name; if all names are times, to the depth that is nearest and
// at most 20 ms away.
PairedFrames pair_frames(const std::vector<std::filesystem::path>& depth,
                         const std::vector<std::filesystem::path>& color);

// The frames of the folder. Warns of what cannot be paired or is not read. Throws Error.
std::vector<FramePaths> folder_frames(const std::filesystem::path& folder);

}  // namespace theatron::capture
