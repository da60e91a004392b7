// SPDX-License-Identifier: Apache-2.0
// What the process that reads an Azure Kinect recording (mkv_reader.h) answers to the one that
// plays it (mkv_file.h).
//
// The reader may have been taken over by the file, so its answers are outside bytes: decoding is
// safe for any. The pictures and the description lie in the memory that both share.
#pragma once

#include <cstdint>
#include <string>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"
#include "image/view.h"

namespace theatron::capture {

enum class MkvRequest : std::uint8_t {
    open = 1,  // from the beginning; answered with a description or what is wrong
    next = 2,  // answered with a picture, or the end
};

// Description of a recording, as its reader sends it.
struct MkvDescription {
    Size depth, color;  // colour 0 x 0: there is none that is JPEG
    double frames_per_second = 0;
    std::string other_color;  // what the colour track holds instead
    std::string calibration;
};

inline constexpr std::size_t max_codec_name = 64;
inline constexpr std::size_t max_calibration_bytes = std::size_t(1) << 20;

struct MkvAnswer {
    enum class Kind : std::uint8_t {
        description = 1,
        depth = 2,
        color = 3,
        end = 4,
        // What is wrong with the file; instead of a description.
        no_matroska = 5,
        no_depth = 6,
        impossible_size = 7,
    };
    Kind kind{};
    Duration time{};          // of a picture
    std::uint32_t bytes = 0;  // in the shared memory
};

Bytes encode(const MkvAnswer& answer);
// Refuses more bytes than the shared memory has.
Result<MkvAnswer> decode_mkv_answer(ByteView message, std::size_t shared_bytes);

Bytes encode(const MkvDescription& description);
Result<MkvDescription> decode_mkv_description(ByteView bytes);

}  // namespace theatron::capture
