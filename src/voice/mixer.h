// SPDX-License-Identifier: Apache-2.0
// A listener's side: the voices of all others, each with its jitter buffer, added. Not in the web
// build.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "base/ids.h"
#include "voice/opus_codec.h"
#include "voice/playout.h"

namespace theatron::voice {

// Not thread safe.
class Mixer {
public:
    // Speakers at once; the one that was silent for longest makes room for another.
    static constexpr std::size_t max_speakers = 32;

    // A packet of this speaker has arrived. One that cannot be read is skipped, and counted.
    void put(ParticipantId speaker, ByteView packet, TimePoint now);
    // Fills `out` with the sum, -1 to 1, to be heard from `now` on.
    void pull(std::span<float> out, TimePoint now);
    struct Heard {
        ParticipantId speaker{};
        std::span<const float> samples;
    };
    // In place of pull(): the next `count` samples of each speaker, valid until the next call.
    std::vector<Heard> pull_each(std::size_t count, TimePoint now);

    struct Speaker {
        ParticipantId id{};
        int level_db = -127;  // -127: silent at present
        Duration delay{};     // see Playout
        Playout::Figures figures;
    };
    std::vector<Speaker> speakers() const;
    std::uint64_t unreadable() const { return unreadable_; }

private:
    struct Voice {
        Decoder decoder;
        Playout playout{decoder};
        TimePoint newest;  // arrival
        std::vector<float> samples;
    };
    std::map<ParticipantId, std::unique_ptr<Voice>> voices_;
    std::uint64_t unreadable_ = 0;
};

}  // namespace theatron::voice
