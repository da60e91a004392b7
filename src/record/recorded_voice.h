// SPDX-License-Identifier: Apache-2.0
// Voices in a recording: who has a track, and one packet of a speaker.
#pragma once

#include <string>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"

namespace theatron::record {

// A person who agreed to be recorded.
struct RecordedVoice {
    ParticipantId person{};
    std::string name;
    bool operator==(const RecordedVoice&) const = default;
};

struct VoicePacket {
    std::uint32_t number = 0;  // counts the speaker's frames, those not sent included; it wraps
    TimePoint time;            // session time of the first sample
    int frame_ms = 20;         // 10 or 20
    bool pauses = false;       // silence follows, of which nothing is sent
    int level_db = -127;       // -127 to 0
    ByteView opus;
};

// A voice track of a segment, as its head describes it.
struct VoiceTrack {
    int number = 0;    // of the track
    std::string name;  // of the person who had agreed when the segment began, else "voice N"
    bool operator==(const VoiceTrack&) const = default;
};

}  // namespace theatron::record
