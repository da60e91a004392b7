// SPDX-License-Identifier: Apache-2.0
// Decodes a whole recording and counts damaged and missing pictures.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "capture/camera.h"
#include "record/recording_file.h"

namespace theatron::exporting {

struct VerifiedPictures {
    std::uint64_t pictures = 0;     // decoded
    std::uint64_t damaged = 0;      // in the file, with changed bytes
    std::uint64_t undecodable = 0;  // whole, but with a damaged or missing reference
    std::uint64_t missing = 0;      // not in the file, according to the frame numbers
    std::uint64_t gaps = 0;         // pauses of more than one and a half periods
};

struct VerifiedMinute {
    VerifiedPictures depth, color;
};

struct Verification {
    // By minute since the recording's beginning, in the order of its cameras.
    std::vector<std::map<int, VerifiedMinute>> cameras;
    bool damaged = false;           // any picture or file
    bool damaged_pictures = false;  // any picture, or a place that may hold some
};

// Throws Error if this build cannot decode the recording.
Verification verify(const std::shared_ptr<const record::RecordingFile>& recording,
                    const std::string& file, const capture::Progress& progress);

// Number of frames that were made between two frames of a stream and are missing. Frame numbers of
// another segment may begin at 0 again.
std::uint64_t frames_between(const record::RecordedFrame& before,
                             const record::RecordedFrame& frame);

}  // namespace theatron::exporting
