// SPDX-License-Identifier: Apache-2.0
#include "wire/envelope.h"

#include <algorithm>
#include <cassert>

namespace theatron::wire {
namespace {

constexpr std::byte kind_control{1};
constexpr std::byte kind_chunk{2};
constexpr std::size_t max_media_size = media_header_size + max_payload_size;

}  // namespace

Bytes wrap_control(ByteView control) {
    assert(!control.empty() && control.size() <= max_control_size);
    Bytes envelope;
    envelope.reserve(1 + control.size());
    envelope.push_back(kind_control);
    envelope.insert(envelope.end(), control.begin(), control.end());
    return envelope;
}

std::size_t wrap_chunk(ByteView media, std::size_t offset, Bytes& out) {
    assert(offset < media.size() && media.size() <= max_media_size);
    const std::size_t size = std::min(usual_chunk_size, media.size() - offset);
    out.resize(chunk_header_size);
    out[0] = kind_chunk;
    store_le(out.data() + 1, std::uint32_t(offset));
    store_le(out.data() + 5, std::uint32_t(media.size()));
    const ByteView chunk = media.subspan(offset, size);
    out.insert(out.end(), chunk.begin(), chunk.end());
    return offset + size;
}

Result<Unwrapper::Unwrapped> Unwrapper::take(ByteView envelope) {
    if (envelope.empty())
        return Status::truncated;
    if (envelope[0] == kind_control) {
        if (envelope.size() == 1)
            return Status::truncated;
        if (envelope.size() > max_envelope_size)
            return Status::too_large;
        return Unwrapped{envelope.subspan(1), {}};
    }
    if (envelope[0] != kind_chunk)
        return Status::malformed;
    if (takes_ == Takes::control)
        return Status::unsupported;
    if (envelope.size() <= chunk_header_size)
        return Status::truncated;

    const std::size_t offset = load_le<std::uint32_t>(envelope.data() + 1);
    const std::size_t total = load_le<std::uint32_t>(envelope.data() + 5);
    const ByteView chunk = envelope.subspan(chunk_header_size);
    if (total > max_media_size || chunk.size() > max_chunk_size)
        return Status::too_large;
    const bool continues = offset == filled_ && (offset == 0 || total == expected_);
    if (!continues || chunk.size() > total - offset)
        return Status::malformed;

    // Memory grows with what has really arrived, not with what was announced.
    media_.resize(offset);
    media_.insert(media_.end(), chunk.begin(), chunk.end());
    filled_ = offset + chunk.size();
    media_bytes_ += chunk.size();
    expected_ = total;
    if (filled_ < total)
        return Unwrapped{};
    filled_ = 0;
    return Unwrapped{{}, media_};
}

}  // namespace theatron::wire
