// SPDX-License-Identifier: Apache-2.0
// The fixed header in front of every media message: enough to relay, drop,
// layer and record it without decoding (docs/formats/media_header.md).
#pragma once

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "base/time.h"

namespace theatron::wire {

inline constexpr std::uint8_t media_version = 1;
inline constexpr std::size_t media_header_size = 64;
inline constexpr std::size_t max_payload_size = std::size_t(64) << 20;
inline constexpr int max_temporal_layer = 7;

struct MediaHeader {
    std::uint8_t codec = 0;  // codec::DepthCodecId or video::ColorCodecId
    bool key = false;        // decodable without any other frame
    std::uint8_t temporal_layer = 0;
    StreamId stream{};
    SettingId setting{};
    FrameNumber frame = 0;
    FrameNumber reference = 0;  // equals `frame` in a key frame
    std::uint16_t slice = 0;    // slice `slice` of `slices` of this frame
    std::uint16_t slices = 1;
    std::uint32_t payload_size = 0;
    TimePoint moment;    // equal for frames of several cameras that belong together
    TimePoint captured;  // session time, as are the following
    TimePoint delivered;
    TimePoint filtered;
    TimePoint encoded;
    TimePoint sent;

    bool operator==(const MediaHeader&) const = default;
};

// Writes the header to `out`, media_header_size bytes. The times after
// `captured` are kept as microseconds after it, up to 71 minutes.
void write_media_header(const MediaHeader& header, std::byte* out);

// Replaces `sent` in an encoded header. `message` begins with a valid header.
void stamp_sent(std::span<std::byte> message, TimePoint sent);

// Reads the header of a whole media message and checks that the payload has the
// size it names. Safe for untrusted input.
Result<MediaHeader> parse_media_header(ByteView message);

// Reads the header alone, from the first media_header_size bytes of `bytes`,
// for a payload that is kept elsewhere. Safe for untrusted input.
Result<MediaHeader> parse_header_alone(ByteView bytes);

// The payload of a message that parse_media_header accepted.
inline ByteView media_payload(ByteView message) {
    return message.subspan(media_header_size);
}

}  // namespace theatron::wire
