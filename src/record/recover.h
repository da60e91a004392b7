// SPDX-License-Identifier: Apache-2.0
// Writes what is whole of a recording into a new one without damage.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "record/recording_file.h"

namespace theatron::record {

struct RecoveredStream {
    std::uint64_t saved = 0;
    std::uint64_t damaged = 0;      // left out
    std::uint64_t undecodable = 0;  // left out: they refer to pictures that are not there
    std::uint64_t repeated = 0;     // left out: of version 1, they stand in it twice
};

struct Recovered {
    // All that the recording held by its numbers and ends is in it: see losses_of(). Pictures that
    // stood twice and are saved once are no loss.
    bool complete = false;
    std::vector<std::string> files;
    std::uint64_t bytes = 0;
    struct Camera {
        RecoveredStream depth, color;
    };
    std::vector<Camera> cameras;  // in the order of the recording
};

// Segment by segment, into files that begin with `out` (segment_path) and are not there yet; times
// and numbers stay. `progress` gets the part that is done, 0 to 1; it may be empty. Throws Error;
// the files that it made are then gone.
Recovered recover(const RecordingFile& recording, const std::filesystem::path& out,
                  const std::function<void(double)>& progress);

}  // namespace theatron::record
