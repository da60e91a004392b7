// SPDX-License-Identifier: Apache-2.0
#include "net/outbox.h"

#include <gtest/gtest.h>

#include <numeric>

#include "wire/control.h"
#include "wire/envelope.h"

namespace theatron::net {
namespace {

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
        if (got && got->media)
            arrived.push_back(*wire::parse_media_header(*got->media));
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
            if (got->media)
                left.push_back(wire::parse_media_header(*got->media)->frame);
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
        ++served[int(wire::parse_media_header(*unwrapper.take(envelope)->media)->stream)];
        for (int stream = 1; stream <= 3; ++stream)
            outbox.push_media(frame(stream, n, true));
    }
    EXPECT_EQ(served, (std::map<int, int>{{1, 10}, {2, 10}, {3, 10}}));
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

TEST(Outbox, HoldsItsShareOfPicturesAndTellsHowLongItStoodStill) {
    Outbox first, second;
    const TimePoint begin = from_us(1'000'000);
    EXPECT_EQ(first.held(begin).bytes, 0u);
    Media media = frame(1, 0, true, 0, 100'000);
    const std::size_t size = media.bytes->size();
    first.push_media(media);
    second.push_media(std::move(media));
    EXPECT_EQ(first.held(begin).bytes, size / 2);
    Bytes envelope;
    ASSERT_TRUE(first.next(envelope, begin));  // a part of it
    EXPECT_EQ(first.held(begin).bytes, size / 2);
    second = Outbox();
    EXPECT_EQ(first.held(begin).bytes, size);
    EXPECT_FALSE(first.stands_still(begin));
    EXPECT_EQ(first.held(begin + 5s).still, Duration(5s));
    EXPECT_FALSE(first.held(begin).records);
}

TEST(Outbox, APeerThatTakesNothingIsToldFromOneThatIsSlow) {
    Outbox outbox;
    const TimePoint begin = from_us(1'000'000);
    Bytes envelope;
    EXPECT_FALSE(outbox.take_figures(begin).takes_nothing) << "nothing is on the way";
    outbox.push_media(frame(1, 0, true, 0, 100'000));
    std::uint64_t sent = 0;
    while (outbox.next(envelope, begin))
        sent += envelope.size();
    EXPECT_TRUE(outbox.take_figures(begin + 100ms).takes_nothing);
    outbox.acknowledge({sent / 2, {}}, begin + 150ms);
    EXPECT_FALSE(outbox.take_figures(begin + 200ms).takes_nothing);
    EXPECT_TRUE(outbox.take_figures(begin + 300ms).takes_nothing);
    outbox.acknowledge({sent, {}}, begin + 350ms);
    EXPECT_FALSE(outbox.take_figures(begin + 400ms).takes_nothing);
    EXPECT_FALSE(outbox.take_figures(begin + 500ms).takes_nothing) << "all was taken";
}

TEST(Outbox, ControlThatNobodyReadsIsGivenUpAsAWhole) {
    Outbox outbox;
    int kept = 0;
    while (outbox.push_control(Bytes(60'000)))
        ++kept;
    EXPECT_GT(kept, 10);
    EXPECT_TRUE(outbox.empty()) << "a part of what was said would be wrong";
    EXPECT_TRUE(outbox.push_control(Bytes(60'000))) << "the state can be sent again";
}

TEST(Outbox, ManySmallControlMessagesCountForWhatTheyCost) {
    Outbox outbox;
    std::size_t waiting = 0;
    while (outbox.push_control(Bytes(2)))
        ++waiting;
    EXPECT_LT(waiting, Outbox::max_control_bytes / Outbox::control_overhead);
}

const Bytes& body(int value) {
    static std::map<int, Bytes> bodies;
    return bodies.try_emplace(value, 4, std::byte(value)).first->second;
}

// The content of the next envelope.
struct Next {
    std::map<std::uint32_t, int> states;
    std::vector<int> voice;
    std::optional<std::uint64_t> acknowledged;
    bool is_media = false, is_control = false;
};
Next next_of(Outbox& outbox, TimePoint now = from_us(2000)) {
    Next result;
    Bytes envelope;
    if (!outbox.next(envelope, now))
        return result;
    result.is_media = envelope[0] == std::byte{2};
    if (result.is_media)
        return result;
    wire::Unwrapper unwrapper;
    const auto got = unwrapper.take(envelope);
    EXPECT_TRUE(got);
    wire::StateReader reader(got->states);
    for (wire::State state; reader.next(state);)
        result.states[state.key.id] = std::to_integer<int>(state.body[0]);
    if (got->voice)
        result.voice.push_back(std::to_integer<int>(got->voice->packet[0]));
    if (got->acknowledgement)
        result.acknowledged = got->acknowledgement->taken;
    result.is_control = !got->control.empty();
    return result;
}

void put_pose(Outbox& outbox, std::uint32_t id, int value) {
    outbox.put_state({{wire::StateTopic::pose, id}, body(value)});
}

TEST(Outbox, OfStatesTheNewestOfEachKeyGoesAndAllInOneEnvelope) {
    Outbox outbox;
    for (int value = 1; value <= 3; ++value)
        for (std::uint32_t id = 1; id <= 8; ++id)
            put_pose(outbox, id, value * 10 + int(id));
    const Next next = next_of(outbox);
    ASSERT_EQ(next.states.size(), 8u);
    for (const auto& [id, value] : next.states)
        EXPECT_EQ(value, 30 + int(id));
    EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, NoStateStarvesWhereOneEnvelopeHoldsNotAll) {
    Outbox outbox;
    const Bytes large(wire::max_state_size, std::byte{1});
    std::map<std::uint32_t, int> served;
    for (int i = 0; i < 9; ++i) {
        for (std::uint32_t id = 1; id <= 21; ++id)
            outbox.put_state({{wire::StateTopic::pose, id}, large});
        for (const auto& [id, value] : next_of(outbox).states)
            ++served[id];
    }
    ASSERT_EQ(served.size(), 21u);
    for (const auto& [id, times] : served)
        EXPECT_EQ(times, 3) << id;
}

TEST(Outbox, StatesWithTooManyKeysAreLeftOut) {
    Outbox outbox;
    for (std::uint32_t id = 0; id < 2 * Outbox::max_waiting_states; ++id)
        put_pose(outbox, id, 1);
    put_pose(outbox, 0, 2);
    std::size_t count = 0;
    int of_the_first = 0;
    while (!outbox.empty()) {
        const Next next = next_of(outbox);
        count += next.states.size();
        if (next.states.contains(0))
            of_the_first = next.states.at(0);
    }
    EXPECT_EQ(count, Outbox::max_waiting_states);
    EXPECT_EQ(of_the_first, 2) << "one that waits is still replaced";
}

TEST(Outbox, OfVoiceTheOldestPacketsOfASpeakerAreGivenUp) {
    Outbox outbox;
    outbox.push_voice({ParticipantId{2}, body(100)});
    for (int i = 1; i <= 10; ++i)
        outbox.push_voice({ParticipantId{1}, body(i)});
    std::vector<int> heard;
    while (!outbox.empty())
        for (const int packet : next_of(outbox).voice)
            heard.push_back(packet);
    EXPECT_EQ(heard, (std::vector<int>{100, 8, 9, 10}));
    for (std::uint32_t speaker = 0; speaker < 1000; ++speaker)
        outbox.push_voice({ParticipantId{speaker}, body(1)});
    for (heard.clear(); !outbox.empty();)
        for (const int packet : next_of(outbox).voice)
            heard.push_back(packet);
    EXPECT_EQ(heard.size(), Outbox::max_waiting_voices);
}

TEST(Outbox, TheClassesGoInTheirOrderAndBeforeALargeFrame) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true, 0, 100'000));
    EXPECT_TRUE(next_of(outbox).is_media);
    put_pose(outbox, 1, 5);
    outbox.push_voice({ParticipantId{1}, body(6)});
    ASSERT_TRUE(outbox.push_control(wire::wrap_control(body(7))));
    outbox.put_acknowledgement({1, {}});
    outbox.put_acknowledgement({2, {}});
    EXPECT_EQ(next_of(outbox).acknowledged, 2u) << "only the newest waits";
    EXPECT_TRUE(next_of(outbox).is_control);
    EXPECT_EQ(next_of(outbox).voice, std::vector<int>{6});
    EXPECT_EQ(next_of(outbox).states, (std::map<std::uint32_t, int>{{1, 5}}));
    EXPECT_TRUE(next_of(outbox).is_media);
}

// The link has stopped: sent bytes stay in flight.
TEST(Outbox, APeerThatTakesNothingHasLittleOnItsWayAndThenTheNewest) {
    Outbox outbox;
    TimePoint now = from_us(1'000'000);
    Bytes envelope;
    std::uint64_t sent = 0;
    const auto send_all = [&] {
        while (outbox.next(envelope, now))
            sent += envelope.size();
    };
    // It did answer.
    outbox.push_media(frame(1, 0, true));
    send_all();
    outbox.acknowledge({sent, {}}, now += 10ms);
    const std::uint64_t before = sent;
    for (int i = 1; i <= 100'000; ++i, now += 11ms) {
        put_pose(outbox, 1, i % 200);
        send_all();
    }
    EXPECT_LE(double(sent - before), Flight::first_window + 2 * Flight::interaction_reserve);
    EXPECT_FALSE(outbox.empty());
    outbox.acknowledge({sent, {}}, now);
    EXPECT_EQ(next_of(outbox, now).states, (std::map<std::uint32_t, int>{{1, 100'000 % 200}}));
}

TEST(Outbox, InteractionCountsInTheCeilingAndMediaYields) {
    const auto media_sent = [](bool with_interaction) {
        Outbox outbox;
        outbox.set_ceiling(100'000);
        std::size_t bytes = 0;
        TimePoint now = from_us(1'000'000);
        Bytes envelope;
        for (FrameNumber n = 0; n < 1000; ++n, now += 10ms) {
            outbox.push_media(frame(1, n, true, 0, 3000));
            if (with_interaction)
                outbox.push_voice({ParticipantId{1}, Bytes(400)});
            while (outbox.next(envelope, now))
                if (envelope[0] == std::byte{2})
                    bytes += envelope.size();
        }
        return bytes;
    };
    const std::size_t alone = media_sent(false), together = media_sent(true);
    EXPECT_GT(alone, 850'000u);
    EXPECT_LT(alone, 1'000'000u);
    EXPECT_LT(together, alone - 400'000);
    EXPECT_GT(together, alone - 700'000);
}

struct Sent {
    std::size_t media = 0, content = 0, poses = 0;  // bytes
    std::vector<char> order;                        // 'm', 'c', 'p'
};

// Takes envelopes until nothing leaves any more, at most `most`.
Sent take(Outbox& outbox, int most, Bytes* content = nullptr) {
    Sent sent;
    Bytes envelope;
    wire::Unwrapper unwrapper;
    for (int i = 0; i < most && outbox.next(envelope, from_us(2000)); ++i) {
        const auto got = unwrapper.take(envelope);
        EXPECT_TRUE(got);
        if (!got->control.empty()) {
            const auto message = wire::decode_to_participant(got->control);
            const auto& piece = std::get<wire::Content>(*message);
            if (content)
                content->insert(content->end(), piece.bytes.begin(), piece.bytes.end());
            sent.content += envelope.size();
            sent.order.push_back('c');
        } else if (got->is_media) {
            sent.media += envelope.size();
            sent.order.push_back('m');
        } else {
            sent.poses += envelope.size();
            sent.order.push_back('p');
        }
    }
    return sent;
}

Outbox::Content content(std::shared_ptr<const Bytes> bytes) {
    const std::size_t size = bytes->size();
    return {{}, std::move(bytes), 0, size};
}

TEST(Outbox, ContentLeavesWholeAndInOrder) {
    auto bytes = std::make_shared<Bytes>(100'000);
    for (std::size_t i = 0; i < bytes->size(); ++i)
        (*bytes)[i] = std::byte(i * 7);
    Outbox outbox;
    EXPECT_TRUE(outbox.push_content({{}, bytes, 1000, 50'000}));
    EXPECT_TRUE(outbox.push_content({{}, bytes, 50'000, 100'000}));
    Bytes got;
    take(outbox, 1000, &got);
    EXPECT_EQ(got, Bytes(bytes->begin() + 1000, bytes->end()));
    EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, ContentThatIsNotThereIsAnsweredWithoutBytes) {
    Outbox outbox;
    EXPECT_TRUE(outbox.push_content({{}, nullptr, 0, 0}));
    Bytes got;
    EXPECT_EQ(take(outbox, 10, &got).order, std::vector<char>{'c'});
    EXPECT_TRUE(got.empty());
    EXPECT_TRUE(outbox.empty());
}

TEST(Outbox, ContentWaitsForPosesAndTakesASmallShareBesidePictures) {
    Outbox outbox;
    outbox.push_media(frame(1, 0, true, 0, 600'000));
    outbox.push_content(content(std::make_shared<Bytes>(300'000)));
    const Bytes pose(20);
    outbox.put_state({{wire::StateTopic::pose, 1}, pose});
    const Sent sent = take(outbox, 37);
    EXPECT_EQ(sent.order.front(), 'p');
    EXPECT_GT(sent.content, 0u);
    EXPECT_LE(sent.content * (Outbox::content_share - 1), sent.media);
    // The next picture does not wait for the content that is left.
    outbox.put_state({{wire::StateTopic::pose, 1}, pose});
    EXPECT_EQ(take(outbox, 1).order, std::vector<char>{'p'});
}

TEST(Outbox, MoreContentThanAFewPartsIsNotQueued) {
    Outbox outbox;
    const auto bytes = std::make_shared<Bytes>(10);
    for (std::size_t i = 0; i < Outbox::max_waiting_content; ++i)
        EXPECT_TRUE(outbox.push_content(content(bytes)));
    EXPECT_FALSE(outbox.push_content(content(bytes)));
}

}  // namespace
}  // namespace theatron::net
