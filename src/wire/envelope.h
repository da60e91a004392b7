// SPDX-License-Identifier: Apache-2.0
// The classes of traffic on one connection (docs/formats/connection.md).
//
// Each WebSocket message is one envelope: a control message whole, one chunk of a media message,
// some states, a packet of voice, or an acknowledgement. Senders drop data by class
// (net/outbox.h). Chunks are small, so that nothing waits long behind a large frame. Chunks of
// one media message come in order and are not mixed with those of another; all else may come
// between them.
#pragma once

#include <compare>
#include <optional>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "wire/media_header.h"

namespace theatron::wire {

inline constexpr std::size_t max_chunk_size = 16 * 1024;  // bytes of media in one envelope
inline constexpr std::size_t chunk_header_size = 9;
// Most bytes of media that a sender puts into one envelope, which then fills one TLS record.
inline constexpr std::size_t usual_chunk_size = max_chunk_size - 64;
inline constexpr std::size_t max_control_size = 64 * 1024;
inline constexpr std::size_t max_envelope_size = max_control_size + 1;
// A participant's first envelope, with its Join, is no larger: all that a host takes in before it
// has seen a token.
inline constexpr std::size_t max_first_envelope_size = 2048;
inline constexpr std::size_t max_state_size = 1024;       // bytes of one state
inline constexpr std::size_t max_states_size = 8 * 1024;  // bytes of one envelope of states
inline constexpr std::size_t max_voice_size = 1500;       // bytes of one packet of voice
// A receiver acknowledges taken media within milliseconds, and everything else after this number of
// unacknowledged bytes. So a sender with a larger window never stops for good.
inline constexpr std::size_t max_untold = 8 * 1024;

// The meaning of a state. Receivers skip unknown topics.
enum class StateTopic : std::uint8_t {
    pose = 1,    // wire/person_pose.h; the id is the participant's
    object = 2,  // of an object that somebody holds (session/room_bytes.h); the id is the object's
    expression = 3,  // wire/face_expression.h; the id is the participant's
    own_face = 4,    // wire/own_face.h; the id is the participant's whose face it is
    face_piece = 5,  // of the sender's own face; the id is the place of its first byte
};

// The name of a state: a newer state with the same key replaces an older one.
struct StateKey {
    StateTopic topic{};
    std::uint32_t id = 0;
    auto operator<=>(const StateKey&) const = default;
};

struct State {
    StateKey key;
    ByteView body;  // 1 to max_state_size bytes
};

struct Voice {
    ParticipantId speaker{};
    ByteView packet;  // 1 to max_voice_size bytes
};

struct Acknowledgement {
    // Bytes of all envelopes taken since the connection began, acknowledgements not counted.
    std::uint64_t taken = 0;
    // Time from the taking of the newest of these to the sending of this acknowledgement.
    Duration held{};
    bool operator==(const Acknowledgement&) const = default;
};

// Puts a control message into an envelope.
Bytes wrap_control(ByteView control);
bool is_control(ByteView envelope);

// Writes the envelope of the chunk of `media` that begins at `offset` and has at most `chunk_size`
// bytes into `out`, replacing its content, and returns the offset of the next chunk.
std::size_t wrap_chunk(ByteView media, std::size_t offset, Bytes& out,
                       std::size_t chunk_size = usual_chunk_size);

// Appends a state to an envelope of states; the first one begins the envelope in an empty `out`.
// False, and nothing is appended, if the envelope would be too large.
bool append_state(const State& state, Bytes& out);

// Both replace the content of `out`.
void wrap_voice(const Voice& voice, Bytes& out);
void wrap_acknowledgement(const Acknowledgement& acknowledgement, Bytes& out);

// The states of one envelope, one after the other.
class StateReader {
public:
    explicit StateReader(ByteView states = {}) : rest_(states) {}
    // False at the end, and where the bytes are not states: then rest() is not empty.
    bool next(State& state);
    ByteView rest() const { return rest_; }

private:
    ByteView rest_;
};

// Takes envelopes apart. Holds at most one media message, at most
// max_payload_size large. Safe for untrusted input.
class Unwrapper {
public:
    enum class Takes { everything, all_but_media };

    // Where media is not taken, it is Status::unsupported from its first chunk on.
    explicit Unwrapper(Takes takes = Takes::everything) : takes_(takes) {}

    struct Unwrapped {
        ByteView control;        // not empty: a control message
        ByteView states;         // not empty: complete and valid for StateReader
        bool is_media = false;   // a chunk of media
        Bytes* media = nullptr;  // not null: a complete media message, which may be moved away or
                                 // exchanged for other memory until the next call
        std::optional<Voice> voice;
        std::optional<Acknowledgement> acknowledgement;
    };

    // The views are valid until the next call. After a status the connection should be closed.
    Result<Unwrapped> take(ByteView envelope);

    // Media is taken from now on, at most `max_message` bytes in one message.
    void take_media(std::size_t max_message);

private:
    Result<Unwrapped> take_chunk(ByteView envelope);

    Takes takes_;
    std::size_t max_message_ = media_header_size + max_payload_size;
    Bytes media_;
    std::size_t filled_ = 0;
    std::size_t expected_ = 0;
};

}  // namespace theatron::wire
