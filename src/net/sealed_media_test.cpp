// SPDX-License-Identifier: Apache-2.0
#include "net/sealed_media.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

using Failure = MediaOpener::Failure;

wire::MediaHeader header_of(FrameNumber frame, StreamId stream = StreamId{4}) {
    wire::MediaHeader header;
    header.stream = stream;
    header.setting = SettingId{7};
    header.frame = frame;
    header.reference = frame;
    header.key = true;
    header.temporal_layer = 2;
    header.captured = from_us(5'000'000);
    header.moment = header.captured;
    header.delivered = header.filtered = header.encoded = header.captured + Duration(700);
    header.sent = header.captured;
    return header;
}

class SealedMedia : public ::testing::Test {
protected:
    SealedMedia() { opener.add_key(1, key); }
    // The failure to open a message; nullopt: it opens.
    std::optional<Failure> problem(ByteView message) {
        Failure failure{};
        opened = opener.open(message, failure);
        return opened ? std::nullopt : std::optional(failure);
    }

    const Bytes key = Bytes(media_seal_key_size, std::byte{9});
    const Bytes payload = {std::byte{1}, std::byte{2}, std::byte{3}};
    MediaSealer sealer{1, key};
    MediaOpener opener;
    std::optional<Bytes> opened;
};

TEST_F(SealedMedia, OpensAsItWasAndHidesItsPayload) {
    const Bytes sealed = sealer.seal(header_of(1), payload);
    EXPECT_EQ(std::search(sealed.begin() + wire::media_header_size, sealed.end(), payload.begin(),
                          payload.end()),
              sealed.end());
    const auto head = wire::parse_media_header(sealed).value();
    EXPECT_EQ(head.payload_size, payload.size() + media_seal_size);
    EXPECT_EQ(head.temporal_layer, 2);
    ASSERT_EQ(problem(sealed), std::nullopt);
    wire::MediaHeader expected = header_of(1);
    expected.payload_size = std::uint32_t(payload.size());
    EXPECT_EQ(wire::parse_media_header(*opened).value(), expected);
    const ByteView back = wire::media_payload(*opened);
    EXPECT_EQ(Bytes(back.begin(), back.end()), payload);
}

TEST_F(SealedMedia, OnlyTheTimeOfSendingCanBeChanged) {
    Bytes sealed = sealer.seal(header_of(1), payload);
    for (std::size_t i = 0; i < sealed.size(); ++i) {
        Bytes changed = sealed;
        changed[i] ^= std::byte{1};
        const auto header = wire::parse_media_header(changed);
        // The last field of the header is `sent`.
        if (header && header->sent != header_of(1).sent)
            continue;
        EXPECT_NE(problem(changed), std::nullopt) << i;
    }
    for (std::size_t size = 0; size < sealed.size(); ++size)
        EXPECT_EQ(problem(ByteView(sealed).first(size)), Failure::forged) << size;
    wire::stamp_sent(sealed, header_of(1).captured + Duration(9'000));
    ASSERT_EQ(problem(sealed), std::nullopt);
    EXPECT_EQ(wire::parse_media_header(*opened)->sent, header_of(1).captured + Duration(9'000));
}

TEST_F(SealedMedia, AMessageOpensOnceAndNoneThatIsOlder) {
    const Bytes first = sealer.seal(header_of(1), payload), second = sealer.seal(header_of(2), {});
    const Bytes other = sealer.seal(header_of(1, StreamId{5}), payload);
    EXPECT_EQ(problem(second), std::nullopt);
    EXPECT_EQ(problem(second), Failure::repeated);
    EXPECT_EQ(problem(first), Failure::repeated);
    EXPECT_EQ(problem(other), std::nullopt) << "streams count apart";
}

TEST_F(SealedMedia, TheNewestTwoKeysOpen) {
    const auto of = [&](std::uint32_t number) {
        return MediaSealer(number, Bytes(media_seal_key_size, std::byte(number)))
            .seal(header_of(number), payload);
    };
    EXPECT_EQ(problem(of(2)), Failure::unknown_key);
    opener.add_key(2, Bytes(media_seal_key_size, std::byte{2}));
    EXPECT_EQ(problem(sealer.seal(header_of(1), payload)), std::nullopt);
    EXPECT_EQ(problem(of(2)), std::nullopt);
    opener.add_key(3, Bytes(media_seal_key_size, std::byte{3}));
    EXPECT_EQ(problem(sealer.seal(header_of(4), payload)), Failure::unknown_key);
    EXPECT_EQ(problem(of(3)), std::nullopt);
    EXPECT_EQ(problem(MediaSealer(3, key).seal(header_of(9), payload)), Failure::repeated)
        << "a count that starts anew";
    Bytes foreign = MediaSealer(3, key).seal(header_of(9, StreamId{6}), payload);
    EXPECT_EQ(problem(foreign), Failure::forged) << "another key of the same number";
}

}  // namespace
}  // namespace theatron::net
