// SPDX-License-Identifier: Apache-2.0
// Writes the undamaged pictures of a recording into a new one without damage.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/recording_file.h"

namespace theatron::record {

struct RecoveredStream {
    std::uint64_t saved = 0;
    std::uint64_t silent = 0;       // saved, too: silence of a voice, which the recorder made
    std::uint64_t damaged = 0;      // left out
    std::uint64_t undecodable = 0;  // left out: they refer to missing pictures
    std::uint64_t repeated = 0;     // left out: second copies in a file of version 1
};

struct Recovered {
    // True if it contains everything that was recorded, according to frame numbers and ends of
    // segments: see losses_of(). Left out second copies are no loss.
    bool complete = false;
    std::vector<std::string> files;
    std::uint64_t bytes = 0;
    struct Camera {
        RecoveredStream depth, color;
    };
    std::vector<Camera> cameras;  // in the order of the recording
    RecoveredStream room;         // parts of the room's state
    RecoveredStream voices;       // Opus packets of all voices
};

// Writes segment by segment into new files with names from `out` (segment_path), which must not
// exist. Times and numbers are kept. `progress` gets the share done, 0 to 1, or is empty. Throws
// Error, also if nothing can be saved, after it has removed the new files.
Recovered recover(const RecordingFile& recording, const std::filesystem::path& out,
                  const std::function<void(double)>& progress);

}  // namespace theatron::record
