// SPDX-License-Identifier: Apache-2.0
// A face's channels out of OSC packets: names of VRCFaceTracking's Unified Expressions and of
// ARKit, under any prefix.
//
// Anything else in the packets is counted and forgotten; no name or value of a sender is kept
// as text.
#pragma once

#include <vector>

#include "base/time.h"
#include "face/osc.h"
#include "face/sources.h"

namespace theatron::face {

struct OscCounts {
    std::uint64_t packets = 0;
    std::uint64_t refused = 0;    // damaged or too large, at least in part
    std::uint64_t used = 0;       // messages that fed a channel
    std::uint64_t unknown = 0;    // messages with other names
    std::uint64_t no_number = 0;  // messages with a known name and no number in range
    std::uint64_t flooded = 0;    // messages beyond the limit of a second
};

class OscFace {
public:
    // A tracker with every name at 200 Hz sends less.
    static constexpr int max_messages_per_second = 50000;

    OscFace();

    // True if the packet fed a channel.
    bool take(ByteView packet, TimePoint now);

    // All that is known by now. ARKit's names win over those of Unified Expressions.
    Mapped mapped() const;
    const OscCounts& counts() const { return counts_; }

private:
    // VRCFaceTracking's binary parameters: JawOpen1, JawOpen2, JawOpen4, JawOpenNegative.
    struct Binary {
        unsigned known = 0, set = 0;
        bool is_negative = false;
    };

    bool use(const OscMessage& message);
    bool use_binary(std::string_view name, bool is_set);
    bool is_flood(TimePoint now);

    std::vector<float> unified_, arkit_;
    std::vector<bool> has_unified_, has_arkit_;
    std::vector<Binary> binary_;
    TimePoint second_began_;
    int messages_of_second_ = 0;
    OscCounts counts_;
};

}  // namespace theatron::face
