// SPDX-License-Identifier: Apache-2.0
#include "voice/packet.h"

#include <algorithm>
#include <cassert>

namespace theatron::voice {
namespace {

constexpr std::uint8_t version = 1;
constexpr std::uint8_t pauses_bit = 1;
constexpr std::int64_t max_packet_us = std::int64_t(1) << 60;

}  // namespace

void write_packet(const Packet& packet, Bytes& out) {
    assert(packet.frame_ms == 10 || packet.frame_ms == 20);
    assert(!packet.opus.empty() && packet.opus.size() <= max_opus_size);
    out.clear();
    ByteWriter writer(out);
    writer.put(version);
    writer.put(std::uint8_t(packet.pauses ? pauses_bit : 0));
    writer.put(std::uint8_t(packet.frame_ms));
    writer.put(std::uint8_t(std::clamp(-packet.level_db, 0, 127)));
    writer.put(packet.number);
    writer.put(to_us(packet.time));
    writer.put_bytes(packet.opus);
}

Result<Packet> parse_packet(ByteView bytes) {
    if (bytes.size() <= packet_header_size)
        return Status::truncated;
    if (bytes.size() > packet_header_size + max_opus_size)
        return Status::too_large;
    ByteReader in(bytes);
    if (in.get<std::uint8_t>() != version)
        return Status::unsupported_version;
    const auto flags = in.get<std::uint8_t>();
    Packet packet;
    packet.frame_ms = in.get<std::uint8_t>();
    const int level = in.get<std::uint8_t>();
    packet.number = in.get<std::uint32_t>();
    const auto us = in.get<std::int64_t>();
    if (flags > pauses_bit || (packet.frame_ms != 10 && packet.frame_ms != 20) || level > 127 ||
        us > max_packet_us || us < -max_packet_us)
        return Status::malformed;
    packet.pauses = (flags & pauses_bit) != 0;
    packet.level_db = -level;
    packet.time = from_us(us);
    packet.opus = in.rest();
    return packet;
}

}  // namespace theatron::voice
