// SPDX-License-Identifier: Apache-2.0
#include "voice/packet.h"

#include <gtest/gtest.h>

namespace theatron::voice {
namespace {

Bytes example() {
    static const Bytes opus(3, std::byte{0xaa});
    Bytes bytes;
    write_packet({0x01020304, from_us(0x0807060504030201 >> 8), 10, true, -20, opus}, bytes);
    return bytes;
}

TEST(VoicePacket, ComesBackAsItWasWritten) {
    const Bytes bytes = example();
    const auto packet = parse_packet(bytes);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->number, 0x01020304u);
    EXPECT_EQ(to_us(packet->time), 0x0807060504030201 >> 8);
    EXPECT_EQ(packet->frame_ms, 10);
    EXPECT_EQ(packet->samples(), 480u);
    EXPECT_TRUE(packet->pauses);
    EXPECT_EQ(packet->level_db, -20);
    EXPECT_EQ(packet->opus.size(), 3u);
}

TEST(VoicePacket, HasTheBytesOfItsPage) {
    const Bytes expected = {std::byte{0x01}, std::byte{0x01}, std::byte{0x0a}, std::byte{0x14},
                            std::byte{0x04}, std::byte{0x03}, std::byte{0x02}, std::byte{0x01},
                            std::byte{0x02}, std::byte{0x03}, std::byte{0x04}, std::byte{0x05},
                            std::byte{0x06}, std::byte{0x07}, std::byte{0x08}, std::byte{0x00},
                            std::byte{0xaa}, std::byte{0xaa}, std::byte{0xaa}};
    EXPECT_EQ(example(), expected);
}

TEST(VoicePacket, IsRefusedIfAFieldIsImpossible) {
    for (std::size_t size = 0; size <= packet_header_size; ++size)
        EXPECT_EQ(parse_packet(ByteView(example()).first(size)).error(), Status::truncated);
    const auto error_with = [](std::size_t at, int value) {
        Bytes bytes = example();
        bytes[at] = std::byte(value);
        return parse_packet(bytes).error();
    };
    EXPECT_EQ(error_with(0, 2), Status::unsupported_version);
    EXPECT_EQ(error_with(1, 2), Status::malformed);
    EXPECT_EQ(error_with(2, 15), Status::malformed);
    EXPECT_EQ(error_with(3, 128), Status::malformed);
    EXPECT_EQ(error_with(15, 0x7f), Status::malformed);
    EXPECT_EQ(parse_packet(Bytes(packet_header_size + max_opus_size + 1)).error(),
              Status::too_large);
}

}  // namespace
}  // namespace theatron::voice
