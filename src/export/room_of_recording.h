// SPDX-License-Identifier: Apache-2.0
// The recorded room of a session for other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/recorded_room.h"

namespace theatron::exporting {

struct RoomSummary {
    std::vector<std::string> people;  // names, in the order of joining; two may be equal
    std::size_t objects = 0;          // that were in the room at some time, without people
    capture::RecordedRoom::Figures figures;
};

// Reads the whole track.
RoomSummary summarize_room(const std::shared_ptr<const record::RecordingFile>& recording);

// The room at `time`, to which it was moved, as one JSON line without its end
// (docs/formats/room.md).
std::string room_line(const capture::RecordedRoom& room, Duration time);

// Writes one JSON line for each moment at which the room changed (docs/formats/room.md). Returns
// the number of lines. Throws Error if the file cannot be written.
std::size_t export_room(const std::shared_ptr<const record::RecordingFile>& recording,
                        const std::filesystem::path& file, capture::RecordedRoom::Figures& figures);

}  // namespace theatron::exporting
