// SPDX-License-Identifier: Apache-2.0
// The people who speak, by the level in each packet of voice: nothing is decoded, and no
// loudspeaker is needed.
#pragma once

#include <map>
#include <set>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"

namespace theatron::voice {

// Reads no clock; use from one thread at a time.
class Speakers {
public:
    // A frame of this level counts as speech. A person speaks until there was none for
    // `pause`, so that the display does not flicker between words.
    static constexpr int speech_db = -50;
    static constexpr Duration pause = std::chrono::milliseconds(900);
    // The first frames alone may be a cough or a knock at the table.
    static constexpr Duration begins_after = std::chrono::milliseconds(150);
    // People that are remembered; the one who was silent for longest makes room.
    static constexpr std::size_t most_speakers = 64;

    // A packet of this speaker has arrived. One that cannot be read is skipped.
    void hear(ParticipantId speaker, ByteView packet, TimePoint now);
    std::set<ParticipantId> speaking(TimePoint now) const;
    // The level of the newest packet of each of them, in dB below full scale.
    std::map<ParticipantId, int> levels_db(TimePoint now) const;

private:
    struct Speech {
        TimePoint begin, newest;  // of frames of speech
        int level_db = 0;
    };
    std::map<ParticipantId, Speech> speech_;
};

}  // namespace theatron::voice
