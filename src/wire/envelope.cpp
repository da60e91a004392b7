// SPDX-License-Identifier: Apache-2.0
#include "wire/envelope.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace theatron::wire {
namespace {

constexpr std::byte kind_control{1};
constexpr std::byte kind_chunk{2};
constexpr std::byte kind_states{3};
constexpr std::byte kind_voice{4};
constexpr std::byte kind_acknowledgement{5};
constexpr std::size_t max_media_size = media_header_size + max_payload_size;
constexpr std::size_t state_header_size = 7;  // topic, id, size
constexpr std::size_t voice_header_size = 5;
constexpr std::size_t acknowledgement_size = 13;

Result<Unwrapper::Unwrapped> take_states(ByteView envelope) {
    if (envelope.size() == 1)
        return Status::truncated;
    if (envelope.size() > max_states_size)
        return Status::too_large;
    StateReader reader(envelope.subspan(1));
    State state;
    while (reader.next(state)) {
    }
    if (!reader.rest().empty())
        return Status::malformed;
    Unwrapper::Unwrapped result;
    result.states = envelope.subspan(1);
    return result;
}

Result<Unwrapper::Unwrapped> take_voice(ByteView envelope) {
    if (envelope.size() <= voice_header_size)
        return Status::truncated;
    if (envelope.size() > voice_header_size + max_voice_size)
        return Status::too_large;
    Unwrapper::Unwrapped result;
    result.voice = {ParticipantId(load_le<std::uint32_t>(envelope.data() + 1)),
                    envelope.subspan(voice_header_size)};
    return result;
}

Result<Unwrapper::Unwrapped> take_acknowledgement(ByteView envelope) {
    if (envelope.size() != acknowledgement_size)
        return envelope.size() < acknowledgement_size ? Status::truncated : Status::trailing_bytes;
    Unwrapper::Unwrapped result;
    result.acknowledgement = {load_le<std::uint64_t>(envelope.data() + 1),
                              Duration(load_le<std::uint32_t>(envelope.data() + 9))};
    return result;
}

}  // namespace

Bytes wrap_control(ByteView control) {
    assert(!control.empty() && control.size() <= max_control_size);
    Bytes envelope;
    envelope.reserve(1 + control.size());
    envelope.push_back(kind_control);
    envelope.insert(envelope.end(), control.begin(), control.end());
    return envelope;
}

bool is_control(ByteView envelope) {
    return !envelope.empty() && envelope.front() == kind_control;
}

std::size_t wrap_chunk(ByteView media, std::size_t offset, Bytes& out, std::size_t chunk_size) {
    assert(offset < media.size() && media.size() <= max_media_size);
    assert(chunk_size > 0 && chunk_size <= max_chunk_size);
    const std::size_t size = std::min(chunk_size, media.size() - offset);
    out.resize(chunk_header_size);
    out[0] = kind_chunk;
    store_le(out.data() + 1, std::uint32_t(offset));
    store_le(out.data() + 5, std::uint32_t(media.size()));
    const ByteView chunk = media.subspan(offset, size);
    out.insert(out.end(), chunk.begin(), chunk.end());
    return offset + size;
}

bool append_state(const State& state, Bytes& out) {
    assert(!state.body.empty() && state.body.size() <= max_state_size);
    if (std::max(out.size(), std::size_t(1)) + state_header_size + state.body.size() >
        max_states_size)
        return false;
    if (out.empty())
        out.push_back(kind_states);
    ByteWriter writer(out);
    writer.put(std::uint8_t(state.key.topic));
    writer.put(state.key.id);
    writer.put(std::uint16_t(state.body.size()));
    writer.put_bytes(state.body);
    return true;
}

void wrap_voice(const Voice& voice, Bytes& out) {
    assert(!voice.packet.empty() && voice.packet.size() <= max_voice_size);
    out.assign(1, kind_voice);
    ByteWriter writer(out);
    writer.put(std::uint32_t(voice.speaker));
    writer.put_bytes(voice.packet);
}

void wrap_acknowledgement(const Acknowledgement& acknowledgement, Bytes& out) {
    constexpr std::int64_t longest = std::numeric_limits<std::uint32_t>::max();
    out.assign(1, kind_acknowledgement);
    ByteWriter writer(out);
    writer.put(acknowledgement.taken);
    writer.put(std::uint32_t(std::clamp<std::int64_t>(acknowledgement.held.count(), 0, longest)));
}

bool StateReader::next(State& state) {
    if (rest_.size() <= state_header_size)
        return false;
    const std::size_t size = load_le<std::uint16_t>(rest_.data() + 5);
    if (size == 0 || size > max_state_size || size > rest_.size() - state_header_size)
        return false;
    state.key.topic = StateTopic(std::to_integer<std::uint8_t>(rest_[0]));
    state.key.id = load_le<std::uint32_t>(rest_.data() + 1);
    state.body = rest_.subspan(state_header_size, size);
    rest_ = rest_.subspan(state_header_size + size);
    return true;
}

void Unwrapper::take_media(std::size_t max_message) {
    takes_ = Takes::everything;
    max_message_ = std::min(max_message, max_media_size);
}

Result<Unwrapper::Unwrapped> Unwrapper::take(ByteView envelope) {
    if (envelope.empty())
        return Status::truncated;
    if (envelope[0] == kind_chunk)
        return take_chunk(envelope);
    if (envelope[0] == kind_states)
        return take_states(envelope);
    if (envelope[0] == kind_voice)
        return take_voice(envelope);
    if (envelope[0] == kind_acknowledgement)
        return take_acknowledgement(envelope);
    if (envelope[0] != kind_control)
        return Status::malformed;
    if (envelope.size() == 1)
        return Status::truncated;
    if (envelope.size() > max_envelope_size)
        return Status::too_large;
    Unwrapped result;
    result.control = envelope.subspan(1);
    return result;
}

Result<Unwrapper::Unwrapped> Unwrapper::take_chunk(ByteView envelope) {
    if (takes_ == Takes::all_but_media)
        return Status::unsupported;
    if (envelope.size() <= chunk_header_size)
        return Status::truncated;

    const std::size_t offset = load_le<std::uint32_t>(envelope.data() + 1);
    const std::size_t total = load_le<std::uint32_t>(envelope.data() + 5);
    const ByteView chunk = envelope.subspan(chunk_header_size);
    if (total > max_message_ || chunk.size() > max_chunk_size)
        return Status::too_large;
    const bool continues = offset == filled_ && (offset == 0 || total == expected_);
    if (!continues || chunk.size() > total - offset)
        return Status::malformed;

    // Memory grows with the received bytes, not with the announced size.
    media_.resize(offset);
    media_.insert(media_.end(), chunk.begin(), chunk.end());
    filled_ = offset + chunk.size();
    expected_ = total;
    Unwrapped result;
    result.is_media = true;
    if (filled_ == total) {
        filled_ = 0;
        result.media = &media_;
    }
    return result;
}

}  // namespace theatron::wire
