// SPDX-License-Identifier: Apache-2.0
// One packet of voice: a header and one Opus frame (docs/formats/voice.md).
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"

namespace theatron::voice {

inline constexpr int sample_rate = 48'000;  // in Hz, of all samples in this module; mono
inline constexpr std::size_t packet_header_size = 16;
inline constexpr std::size_t max_opus_size = 1275;  // bytes of one Opus frame (RFC 6716, 3.2.1)

struct Packet {
    // Counts the speaker's frames, those that were not sent included. It wraps.
    std::uint32_t number = 0;
    TimePoint time;     // session time of the first sample
    int frame_ms = 20;  // 10 or 20
    // The speaker is silent from here on: frames after this one are not sent until the next packet.
    bool pauses = false;
    int level_db = -127;  // of this frame, -127 to 0 relative to full scale
    ByteView opus;        // 1 to max_opus_size bytes

    std::size_t samples() const { return std::size_t(frame_ms) * sample_rate / 1000; }
};

// Replaces the content of `out`.
void write_packet(const Packet& packet, Bytes& out);

// Safe for untrusted input. The result's view is into `bytes`; the Opus frame itself is not
// checked.
Result<Packet> parse_packet(ByteView bytes);

}  // namespace theatron::voice
