// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <numeric>
#include <random>

#include "base/error.h"
#include "net/certificate.h"
#include "net/clock_sync.h"
#include "net/link.h"
#include "net/outbox.h"
#include "wire/envelope.h"

namespace theatron::net {
namespace {

TEST(Link, RoundTrips) {
    const std::string fingerprint(64, 'a');
    for (const char* host : {"127.0.0.1", "or-3.hospital.example", "fe80::1"}) {
        const Link link = parse_link(format_link({host, 4400, "secret", fingerprint}));
        EXPECT_EQ(link.host, host);
        EXPECT_EQ(link.port, 4400);
        EXPECT_EQ(link.token, "secret");
        EXPECT_EQ(link.fingerprint, fingerprint);
    }
}

TEST(Link, SaysWhatIsWrong) {
    const std::string f(64, 'a');
    for (const std::string& text :
         {std::string("http://h:1/#join=t&cert=") + f, std::string("https://h/#join=t&cert=") + f,
          std::string("https://h:99999/#join=t&cert=") + f, std::string("https://h:1/#cert=") + f,
          std::string("https://h:1/#join=t"), std::string("https://h:1/#join=t&cert=zz"),
          std::string()})
        EXPECT_THROW(parse_link(text), Error) << text;
}

TEST(Endpoint, Parses) {
    EXPECT_EQ(parse_endpoint("127.0.0.1:0").address, "127.0.0.1");
    EXPECT_EQ(parse_endpoint("[::1]:5").address, "::1");
    EXPECT_EQ(parse_endpoint(":4400").address, "0.0.0.0");
    EXPECT_EQ(parse_endpoint(":4400").port, 4400);
    for (const char* text : {"4400", "h:", "h:x", "h:70000", "::1:5"})
        EXPECT_THROW(parse_endpoint(text), Error) << text;
}

TEST(Certificate, IsMadeOnceAndKept) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("theatron_cert_" + random_token());
    const Certificate made = load_or_make_certificate(folder);
    const Certificate loaded = load_or_make_certificate(folder);
    EXPECT_EQ(made.fingerprint, loaded.fingerprint);
    EXPECT_EQ(made.fingerprint.size(), 64u);
    struct stat info {};
    ASSERT_EQ(stat((folder / "host.key").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0600u);

    std::filesystem::resize_file(folder / "host.key", 20);
    EXPECT_THROW(load_or_make_certificate(folder), Error);
    std::filesystem::remove_all(folder);
}

TEST(Certificate, SecretsCompare) {
    EXPECT_TRUE(equal_secrets("abc", "abc"));
    EXPECT_FALSE(equal_secrets("abc", "abd"));
    EXPECT_FALSE(equal_secrets("abc", "ab"));
    EXPECT_NE(random_token(), random_token());
}

// A host whose clock is ahead by `offset`, over ways of random length.
TEST(ClockSync, FindsTheOffsetWithinItsBound) {
    std::mt19937 rng(1);
    const Duration offset = 123456us;
    ClockSync sync;
    EXPECT_FALSE(sync.known());
    TimePoint local{};
    for (int i = 0; i < 50; ++i) {
        const Duration there = Duration(2000 + rng() % 20000),
                       back = Duration(2000 + rng() % 20000);
        const TimePoint received = local + there + offset;
        sync.add(local, received, received + 100us, local + there + 100us + back);
        local += 100ms;
        EXPECT_LE(abs(sync.offset() - offset), sync.error_bound());
    }
    EXPECT_LT(sync.error_bound(), 8ms);
}

TEST(ClockSync, IgnoresImpossibleAnswers) {
    ClockSync sync;
    sync.add(from_us(100), from_us(50), from_us(50), from_us(90));
    sync.add(from_us(100), from_us(50), from_us(40), from_us(190));
    EXPECT_FALSE(sync.known());
}

Media frame(int stream, FrameNumber number, bool key, int layer = 0, std::size_t size = 100) {
    Media m;
    auto bytes = std::make_shared<Bytes>(wire::media_header_size + size);
    wire::MediaHeader h;
    h.stream = StreamId(stream);
    h.frame = number;
    h.key = key;
    h.reference = key ? number : number - 1;
    h.temporal_layer = std::uint8_t(layer);
    h.payload_size = std::uint32_t(size);
    h.captured = from_us(1000);
    wire::write_media_header(h, bytes->data());
    m.bytes = bytes;
    m.stream = h.stream;
    m.frame = number;
    m.reference = h.reference;
    m.temporal_layer = layer;
    m.key = key;
    return m;
}

// Sends everything and returns the headers that arrive.
std::vector<wire::MediaHeader> drain(Outbox& outbox) {
    std::vector<wire::MediaHeader> arrived;
    wire::Unwrapper unwrapper;
    Bytes envelope;
    while (outbox.next(envelope, from_us(2000))) {
        const auto got = unwrapper.take(envelope);
        EXPECT_TRUE(got);
        if (got && !got->media.empty())
            arrived.push_back(*wire::parse_media_header(got->media));
    }
    return arrived;
}

std::vector<FrameNumber> numbers(const std::vector<wire::MediaHeader>& headers) {
    std::vector<FrameNumber> result;
    for (const auto& h : headers)
        result.push_back(h.frame);
    return result;
}

TEST(Outbox, SendsEverythingToAFastPeer) {
    Outbox outbox;
    std::vector<FrameNumber> got;
    for (FrameNumber n = 0; n < 10; ++n) {
        EXPECT_EQ(outbox.push_media(frame(1, n, n == 0)).dropped, 0);
        for (const auto& h : drain(outbox)) {
            got.push_back(h.frame);
            EXPECT_EQ(h.sent, from_us(2000));
        }
    }
    EXPECT_EQ(got.size(), 10u);
    EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, IsBehindWhileAFrameHasNotBegunToLeave) {
    Outbox outbox;
    EXPECT_FALSE(outbox.is_behind(StreamId{1}));
    (void)outbox.push_media(frame(1, 0, true, 0, 100'000));
    EXPECT_TRUE(outbox.is_behind(StreamId{1}));
    EXPECT_FALSE(outbox.is_behind(StreamId{2}));
    Bytes envelope;
    ASSERT_TRUE(outbox.next(envelope, from_us(2000)));
    EXPECT_FALSE(outbox.is_behind(StreamId{1}));
}

TEST(Outbox, KeepsEverythingForAPeerThatRecords) {
    Outbox outbox;
    outbox.keep_everything();
    EXPECT_TRUE(outbox.push_media(frame(1, 0, false)).needs_key) << "it begins with a key frame";
    for (FrameNumber n = 1; n < 100; ++n)
        EXPECT_EQ(outbox.push_media(frame(1, n, n % 10 == 1)).dropped, 0);
    EXPECT_FALSE(outbox.is_behind(StreamId{1})) << "nobody waits for it";
    std::vector<FrameNumber> all(99);
    std::iota(all.begin(), all.end(), 1);
    EXPECT_EQ(numbers(drain(outbox)), all);
}

TEST(Outbox, AFullOneGivesUpFramesUntilHalfHasLeftAndGoesOnWithAKeyFrame) {
    constexpr std::size_t frame_size = std::size_t(1) << 20;
    constexpr FrameNumber room = Outbox::max_kept_bytes / (frame_size + wire::media_header_size);
    Outbox outbox;
    outbox.keep_everything();
    const auto push = [&](FrameNumber number, bool key) {
        return outbox.push_media(frame(1, number, key, 0, frame_size));
    };
    for (FrameNumber n = 0; n < room; ++n)
        EXPECT_EQ(push(n, n == 0).dropped, 0);
    const auto full = push(room, true);
    EXPECT_EQ(full.dropped, 1);
    EXPECT_FALSE(full.needs_key) << "there is no room for it yet";

    // Whole frames leave until half of the room is free.
    std::vector<FrameNumber> left;
    wire::Unwrapper unwrapper;
    Bytes envelope;
    const auto send_one = [&] {
        for (std::size_t before = left.size(); left.size() == before;) {
            ASSERT_TRUE(outbox.next(envelope, from_us(2000)));
            const auto got = unwrapper.take(envelope);
            ASSERT_TRUE(got);
            if (!got->media.empty())
                left.push_back(wire::parse_media_header(got->media)->frame);
        }
    };
    for (FrameNumber n = 0; n < room / 4; ++n)
        send_one();
    EXPECT_EQ(push(room + 1, true).dropped, 1) << "not yet";
    for (FrameNumber n = 0; n < room / 4 + 3; ++n)
        send_one();
    EXPECT_TRUE(push(room + 2, false).needs_key) << "its reference was given up";
    EXPECT_EQ(push(room + 3, true).dropped, 0);
    EXPECT_EQ(push(room + 4, false).dropped, 0);
    while (!outbox.empty())
        send_one();
    std::vector<FrameNumber> expected(room);
    std::iota(expected.begin(), expected.end(), 0);
    expected.insert(expected.end(), {room + 3, room + 4});
    EXPECT_EQ(left, expected);
}

TEST(Outbox, ControlOvertakesALargeFrame) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true, 0, 100'000));
    Bytes envelope;
    ASSERT_TRUE(outbox.next(envelope, {}));
    const Bytes control = wire::wrap_control(Bytes(3, std::byte{7}));
    ASSERT_TRUE(outbox.push_control(control));
    ASSERT_TRUE(outbox.next(envelope, {}));
    EXPECT_EQ(envelope, control);
    ASSERT_TRUE(outbox.next(envelope, {}));
    EXPECT_GT(envelope.size(), 10'000u);
}

TEST(Outbox, StartsAStreamWithAKeyFrame) {
    Outbox outbox;
    const auto pushed = outbox.push_media(frame(1, 5, false));
    EXPECT_EQ(pushed.dropped, 1);
    EXPECT_TRUE(pushed.needs_key);
    EXPECT_FALSE(outbox.push_media(frame(1, 6, true)).needs_key);
    EXPECT_EQ(numbers(drain(outbox)), std::vector<FrameNumber>{6});
}

TEST(Outbox, ABlockedPeerGetsTheNewestKeyFrameAndNothingOlder) {
    Outbox outbox;
    bool needs_key = false;
    for (FrameNumber n = 0; n < 100; ++n) {
        needs_key = outbox.push_media(frame(1, n, n == 0)).needs_key;
        EXPECT_LE(outbox.waiting_frames(), Outbox::max_waiting);
    }
    EXPECT_TRUE(needs_key);
    outbox.push_media(frame(1, 100, true));
    outbox.push_media(frame(1, 101, false));
    EXPECT_EQ(numbers(drain(outbox)), (std::vector<FrameNumber>{100, 101}));
}

TEST(Outbox, FramesThatStandAloneReplaceEachOther) {
    Outbox outbox;
    for (FrameNumber n = 0; n < 10; ++n)
        EXPECT_FALSE(outbox.push_media(frame(1, n, true)).needs_key);
    EXPECT_EQ(numbers(drain(outbox)), std::vector<FrameNumber>{9});
}

TEST(Outbox, UpperLayersGoFirstAndBreakNothing) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true));
    auto upper = frame(1, 1, false, 1);
    outbox.push_media(upper);
    auto base = frame(1, 2, false, 0);
    base.reference = 0;
    const auto pushed = outbox.push_media(base);
    EXPECT_EQ(pushed.dropped, 1);
    EXPECT_FALSE(pushed.needs_key);
    EXPECT_EQ(numbers(drain(outbox)), (std::vector<FrameNumber>{0, 2}));
}

TEST(Outbox, NewSettingStartsWithAKeyFrame) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true));
    Media other = frame(1, 1, false);
    other.setting = SettingId{1};
    EXPECT_TRUE(outbox.push_media(other).needs_key);
}

TEST(Outbox, NoStreamStarves) {
    Outbox outbox;
    for (int stream = 1; stream <= 3; ++stream)
        outbox.push_media(frame(stream, 0, true));
    Bytes envelope;
    std::map<int, int> served;
    wire::Unwrapper unwrapper;
    for (FrameNumber n = 1; n <= 30; ++n) {
        // One message goes out while each of three streams gets a new one.
        ASSERT_TRUE(outbox.next(envelope, {}));
        ++served[int(wire::parse_media_header(unwrapper.take(envelope)->media)->stream)];
        for (int stream = 1; stream <= 3; ++stream)
            outbox.push_media(frame(stream, n, true));
    }
    EXPECT_EQ(served, (std::map<int, int>{{1, 10}, {2, 10}, {3, 10}}));
}

TEST(Outbox, GivesUpAPeerThatNeverReads) {
    Outbox outbox;
    bool fine = true;
    for (int i = 0; i < 100 && fine; ++i)
        fine = outbox.push_control(Bytes(60'000));
    EXPECT_FALSE(fine);
}

TEST(Outbox, OnlyTheNewestAcknowledgementWaits) {
    Outbox outbox;
    outbox.put_acknowledgement(Bytes(3, std::byte{1}));
    outbox.put_acknowledgement(Bytes(3, std::byte{2}));
    Bytes envelope;
    ASSERT_TRUE(outbox.next(envelope, {}));
    EXPECT_EQ(envelope, Bytes(3, std::byte{2}));
    EXPECT_FALSE(outbox.next(envelope, {}));
}

TEST(Outbox, AsksForAKeyFrameOnceWhileThePeerTakesNothing) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true, 0, 100'000));
    Bytes envelope;
    ASSERT_TRUE(outbox.next(envelope, {}));
    int asked = 0;
    for (FrameNumber n = 1; n < 100; ++n) {
        asked += outbox.push_media(frame(1, n, n % 10 == 0)).needs_key;
        EXPECT_LE(outbox.waiting_frames(), 1 + Outbox::max_waiting);
    }
    EXPECT_EQ(asked, 1);
    ASSERT_TRUE(outbox.next(envelope, {}));
    for (FrameNumber n = 100; n < 110; ++n)
        asked += outbox.push_media(frame(1, n, false)).needs_key;
    EXPECT_EQ(asked, 2);
}

TEST(Outbox, APeerThatTakesNothingIsGivenUpAfterATime) {
    Outbox outbox;
    const TimePoint begin = from_us(1'000'000);
    Bytes envelope;
    EXPECT_FALSE(outbox.stands_still(begin));
    EXPECT_FALSE(outbox.stands_still(begin + 2 * Outbox::give_up_after)) << "nothing waits";

    const TimePoint sent = begin + 3 * Outbox::give_up_after;
    outbox.push_media(frame(1, 0, true, 0, 100'000));
    ASSERT_TRUE(outbox.next(envelope, sent));
    EXPECT_FALSE(outbox.stands_still(sent));
    EXPECT_FALSE(outbox.stands_still(sent + Outbox::give_up_after - 1us));
    EXPECT_TRUE(outbox.stands_still(sent + Outbox::give_up_after));
    // It took something after all.
    ASSERT_TRUE(outbox.next(envelope, sent + Outbox::give_up_after));
    EXPECT_FALSE(outbox.stands_still(sent + Outbox::give_up_after));
}

TEST(Outbox, ManySmallControlMessagesCountForWhatTheyCost) {
    Outbox outbox;
    std::size_t waiting = 0;
    while (outbox.push_control(Bytes(2)))
        ++waiting;
    EXPECT_LT(waiting, Outbox::max_control_bytes / Outbox::control_overhead);
}

}  // namespace
}  // namespace theatron::net
