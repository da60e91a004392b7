// SPDX-License-Identifier: Apache-2.0
// Makes a gapless sequence of Opus packets of a voice: silence where nothing was sent or something
// was lost, so that players that only count samples stay in sync with the pictures.
//
// Packets begin at multiples of 10 ms from the segment's beginning. A packet is at most
// max_voice_error from the time that its speaker says; where the clocks of the two drift apart by
// more, silence is inserted or a packet left out.
//
// Pure. Not thread safe.
#pragma once

#include <functional>
#include <optional>

#include "record/recorded_voice.h"

namespace theatron::record {

inline constexpr Duration voice_step = std::chrono::milliseconds(10);
inline constexpr Duration max_voice_error = std::chrono::milliseconds(30);

class VoiceSequence {
public:
    struct Block {
        Duration at{};           // since the segment's beginning
        bool is_silence = true;  // made here
        int level_db = -127;
        ByteView opus;  // valid during the call
    };
    using Write = std::function<void(const Block&)>;

    // `begin`: session time of the segment's beginning.
    explicit VoiceSequence(TimePoint begin) : begin_(begin) {}

    // A packet of the speaker. It is left out if its place has been filled already.
    void put(const VoicePacket& packet, const Write& write);
    // Packets may have been withheld on purpose from here on: they do not count as missing.
    void interrupt() { speaks_ = false; }
    // Another person speaks from here on, with numbers and figures of their own.
    void begin_speaker() {
        speaks_ = false;
        newest_.reset();
        figures_ = {};
    }
    // Everything before session time `until` has come or will not come: fills with silence up to
    // there, in whole blocks of 120 ms. Before the first packet, too.
    void fill(TimePoint until, const Write& write);

    TimePoint begin() const { return begin_; }

    struct Figures {
        std::uint64_t packets = 0;   // of the speaker, written
        std::uint64_t missing = 0;   // frames that were lost on the way
        std::uint64_t left_out = 0;  // too late, or too many
    };
    const Figures& figures() const { return figures_; }

private:
    void silence(std::int64_t steps, const Write& write);

    TimePoint begin_;
    std::int64_t next_ = 0;  // the next block's place, in steps
    bool speaks_ = false;    // the block before is a packet after which there is no pause
    std::optional<std::uint32_t> newest_;  // its number
    Figures figures_;
};

}  // namespace theatron::record
