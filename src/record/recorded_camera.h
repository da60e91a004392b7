// SPDX-License-Identifier: Apache-2.0
// The description of a camera at the beginning of a segment of a recording.
#pragma once

#include <optional>
#include <string>

#include "base/bytes.h"
#include "base/ids.h"

namespace theatron::record {

struct RecordedStream {
    std::string codec;  // its setting in full: "zstd:delta=1", "jpeg:quality=85"
    int width = 0, height = 0;
    bool operator==(const RecordedStream&) const = default;
};

struct RecordedCamera {
    CameraId id{};
    std::string name;
    double frames_per_second = 0;
    Bytes calibration;  // as geometry/calibration.h writes it
    RecordedStream depth;
    std::optional<RecordedStream> color;
    bool operator==(const RecordedCamera&) const = default;
};

}  // namespace theatron::record
