// SPDX-License-Identifier: Apache-2.0
// Messages between the process that reads an Azure Kinect recording (mkv_reader.h) and the
// process that plays it (mkv_file.h).
//
// The file may have compromised the reader, so its answers are untrusted: decoding is safe for
// any bytes. Pictures and the description are in the shared memory.
#pragma once

#include <cstdint>
#include <string>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"
#include "image/view.h"

namespace theatron::capture {

enum class MkvRequest : std::uint8_t {
    open = 1,  // read from the beginning; the answer is a description or a problem
    next = 2,  // the answer is a picture or the end
};

// Description of a recording, sent by its reader.
struct MkvDescription {
    Size depth, color;  // colour 0 x 0: no JPEG track
    double frames_per_second = 0;
    std::string other_color;  // format of a colour track that is not JPEG or not called so
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
        // Problems with the file, instead of a description.
        no_matroska = 5,
        no_depth = 6,
        impossible_size = 7,
        infrared_only = 8,
    };
    Kind kind{};
    Duration time{};          // of the picture
    std::uint32_t bytes = 0;  // in the shared memory
};

Bytes encode(const MkvAnswer& answer);
// Refuses an answer with more bytes than the shared memory has.
Result<MkvAnswer> decode_mkv_answer(ByteView message, std::size_t shared_bytes);

Bytes encode(const MkvDescription& description);
Result<MkvDescription> decode_mkv_description(ByteView bytes);

}  // namespace theatron::capture
