// SPDX-License-Identifier: Apache-2.0
// How control and media share one connection (docs/formats/connection.md).
//
// Each WebSocket message is one envelope: a control message whole, or one chunk
// of a media message. Chunks are small, so that control never waits long behind
// a large frame. Chunks of one media message come in order and are not mixed
// with those of another; control may come between them.
#pragma once

#include <optional>

#include "base/bytes.h"
#include "base/status.h"
#include "wire/media_header.h"

namespace theatron::wire {

inline constexpr std::size_t max_chunk_size = 16 * 1024;  // bytes of media in one envelope
inline constexpr std::size_t chunk_header_size = 9;
// What we put into one: with the headers in front of it, it fills one TLS record.
inline constexpr std::size_t usual_chunk_size = max_chunk_size - 64;
inline constexpr std::size_t max_control_size = 64 * 1024;
inline constexpr std::size_t max_envelope_size = max_control_size + 1;
// A participant's first envelope, with its Join, is no larger: all that a host takes in before it
// has seen a token.
inline constexpr std::size_t max_first_envelope_size = 2048;

// Puts a control message into an envelope.
Bytes wrap_control(ByteView control);

// Writes the envelope of the chunk of `media` that begins at `offset` into
// `out`, replacing its content, and returns the offset of the next chunk.
std::size_t wrap_chunk(ByteView media, std::size_t offset, Bytes& out);

// Takes envelopes apart. Holds at most one media message, at most
// max_payload_size large. Safe for untrusted input.
class Unwrapper {
public:
    enum class Takes { control_and_media, control };

    // Where only control is taken, media is Status::unsupported from its first chunk on.
    explicit Unwrapper(Takes takes = Takes::control_and_media) : takes_(takes) {}

    struct Unwrapped {
        ByteView control;  // not empty: a control message
        ByteView media;    // not empty: a complete media message
    };

    // Both views are empty while a media message is incomplete. They are valid
    // until the next call. After a status the connection should be closed.
    Result<Unwrapped> take(ByteView envelope);

    // Bytes of media in all chunks so far.
    std::uint64_t media_bytes() const { return media_bytes_; }

private:
    Takes takes_;
    Bytes media_;
    std::size_t filled_ = 0;
    std::size_t expected_ = 0;
    std::uint64_t media_bytes_ = 0;
};

}  // namespace theatron::wire
