// SPDX-License-Identifier: Apache-2.0
#include "wire/media_header.h"

#include <algorithm>
#include <cassert>

namespace theatron::wire {
namespace {

// Byte offsets of the fields.
enum : std::size_t {
    at_version = 0,
    at_codec = 1,
    at_flags = 2,
    at_layer = 3,
    at_stream = 4,
    at_setting = 6,
    at_frame = 8,
    at_reference = 12,
    at_slice = 16,
    at_slices = 18,
    at_payload_size = 20,
    at_moment = 24,
    at_captured = 32,
    at_delivered = 40,
    at_filtered = 44,
    at_encoded = 48,
    at_sent = 52,
    at_reserved = 56,  // eight bytes, zero
};

constexpr std::uint8_t flag_key = 1;

// The offset of a time that is unknown or before `captured`.
constexpr std::uint32_t unknown_offset = UINT32_MAX;

std::uint32_t after_captured(TimePoint t, TimePoint captured) {
    if (t == TimePoint{} || t < captured)
        return unknown_offset;
    return std::uint32_t(std::min<std::int64_t>((t - captured).count(), unknown_offset - 1));
}

TimePoint from_offset(std::uint32_t offset, TimePoint captured) {
    return offset == unknown_offset ? TimePoint{} : captured + Duration(offset);
}

}  // namespace

void write_media_header(const MediaHeader& h, std::byte* out) {
    assert(h.payload_size <= max_payload_size && h.slice < h.slices);
    std::fill_n(out, media_header_size, std::byte{});
    store_le(out + at_version, media_version);
    store_le(out + at_codec, h.codec);
    store_le(out + at_flags, std::uint8_t(h.key ? flag_key : 0));
    store_le(out + at_layer, h.temporal_layer);
    store_le(out + at_stream, std::uint16_t(h.stream));
    store_le(out + at_setting, std::uint16_t(h.setting));
    store_le(out + at_frame, h.frame);
    store_le(out + at_reference, h.reference);
    store_le(out + at_slice, h.slice);
    store_le(out + at_slices, h.slices);
    store_le(out + at_payload_size, h.payload_size);
    store_le(out + at_moment, to_us(h.moment));
    store_le(out + at_captured, to_us(h.captured));
    store_le(out + at_delivered, after_captured(h.delivered, h.captured));
    store_le(out + at_filtered, after_captured(h.filtered, h.captured));
    store_le(out + at_encoded, after_captured(h.encoded, h.captured));
    store_le(out + at_sent, after_captured(h.sent, h.captured));
}

void stamp_sent(std::span<std::byte> message, TimePoint sent) {
    assert(message.size() >= media_header_size);
    const TimePoint captured = from_us(load_le<std::int64_t>(message.data() + at_captured));
    store_le(message.data() + at_sent, after_captured(sent, captured));
}

Result<MediaHeader> parse_header_alone(ByteView message) {
    if (message.empty())
        return Status::truncated;
    if (load_le<std::uint8_t>(message.data() + at_version) != media_version)
        return Status::unsupported_version;
    if (message.size() < media_header_size)
        return Status::truncated;

    const std::byte* in = message.data();
    MediaHeader h;
    h.codec = load_le<std::uint8_t>(in + at_codec);
    const auto flags = load_le<std::uint8_t>(in + at_flags);
    h.key = flags & flag_key;
    h.temporal_layer = load_le<std::uint8_t>(in + at_layer);
    h.stream = StreamId(load_le<std::uint16_t>(in + at_stream));
    h.setting = SettingId(load_le<std::uint16_t>(in + at_setting));
    h.frame = load_le<std::uint32_t>(in + at_frame);
    h.reference = load_le<std::uint32_t>(in + at_reference);
    h.slice = load_le<std::uint16_t>(in + at_slice);
    h.slices = load_le<std::uint16_t>(in + at_slices);
    h.payload_size = load_le<std::uint32_t>(in + at_payload_size);
    h.moment = from_us(load_le<std::int64_t>(in + at_moment));
    h.captured = from_us(load_le<std::int64_t>(in + at_captured));
    // Time points are later subtracted and added to: keep them far from overflow.
    constexpr std::int64_t max_us = std::int64_t(1) << 60;
    const auto sane = [](TimePoint t) { return to_us(t) > -max_us && to_us(t) < max_us; };
    if (flags > flag_key || h.temporal_layer > max_temporal_layer || h.slice >= h.slices ||
        h.key != (h.reference == h.frame) || !sane(h.moment) || !sane(h.captured) ||
        load_le<std::uint64_t>(in + at_reserved) != 0)
        return Status::malformed;
    if (h.payload_size > max_payload_size)
        return Status::too_large;
    h.delivered = from_offset(load_le<std::uint32_t>(in + at_delivered), h.captured);
    h.filtered = from_offset(load_le<std::uint32_t>(in + at_filtered), h.captured);
    h.encoded = from_offset(load_le<std::uint32_t>(in + at_encoded), h.captured);
    h.sent = from_offset(load_le<std::uint32_t>(in + at_sent), h.captured);
    return h;
}

Result<MediaHeader> parse_media_header(ByteView message) {
    const Result<MediaHeader> header = parse_header_alone(message);
    if (!header)
        return header;
    const std::size_t payload = message.size() - media_header_size;
    if (payload < header->payload_size)
        return Status::truncated;
    return payload > header->payload_size ? Result<MediaHeader>(Status::trailing_bytes) : header;
}

}  // namespace theatron::wire
