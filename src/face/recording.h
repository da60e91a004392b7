// SPDX-License-Identifier: Apache-2.0
// Takes of a face's channels, each with the emotion that was asked for, as CSV text.
//
//     # theatron face 1
//     # source xr_fb
//     # synthetic no
//     time_s,take,label,BROW_LOWERER_L,BROW_LOWERER_R,...
//     0.000,0,neutral,0.02,0.01,...
//
// The columns are named as the source names its values (sources.h), in any order and with the
// header's prefix or without; a column that the source does not know is refused. An empty field
// is a value that is missing. In what is written the columns are ARKit's, and the source says which
// tracker they come from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "face/emotion.h"
#include "face/sources.h"

namespace theatron::face {

struct Sample {
    float time_s = 0;
    Channels values{};
};

struct Take {
    int person = 0;  // 0: the user
    Emotion label = Emotion::neutral;
    ChannelMask present;
    std::vector<Sample> samples;  // in the order of their times
};

struct Recording {
    Source source = Source::arkit;
    bool is_synthetic = false;
    std::vector<Take> takes;
    std::size_t left_out_rows = 0;  // of emotions that are none of the six, such as fear
};

struct RecordingRead {
    Recording recording;
    // Empty if it was read; otherwise what is wrong, to follow the file's name: "line 7: ...". It
    // repeats nothing of the file.
    std::string problem;
};

inline constexpr std::size_t max_recording_rows = 500000;

// Safe on any text.
RecordingRead parse_recording(std::string_view text);
std::string recording_text(const Recording& recording);

}  // namespace theatron::face
