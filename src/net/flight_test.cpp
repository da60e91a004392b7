// SPDX-License-Identifier: Apache-2.0
#include "net/flight.h"

#include <gtest/gtest.h>

#include <deque>
#include <optional>

namespace theatron::net {
namespace {

constexpr std::size_t chunk = 16 * 1024;

// A path with a rate, a deep buffer and a delay; the sender always has more to send.
struct Way {
    Flight flight;
    double bytes_per_second = 5e6;
    Duration round_trip = 60ms;
    TimePoint now = from_us(1'000'000);
    std::uint64_t total = 0;

    void run(double seconds) {
        for (const TimePoint end = now + seconds_to_duration(seconds); now < end; now += 500us) {
            for (; !answers_.empty() && answers_.front().at <= now; answers_.pop_front()) {
                flight.acknowledge(answers_.front().total, {}, now);
                answered_ = true;
            }
            // Nothing holds back a sender that has had no answer yet.
            while (flight.may_send(now) && (answered_ || total == 0)) {
                flight.sent(chunk, now, true, now);
                total += chunk;
                free_at_ =
                    std::max(free_at_, now) + seconds_to_duration(double(chunk) / bytes_per_second);
                answers_.push_back({free_at_ + round_trip, total});
            }
        }
    }
    Duration queue() const { return std::max(free_at_ - now, Duration(0)); }

private:
    struct Answer {
        TimePoint at;
        std::uint64_t total;
    };
    std::deque<Answer> answers_;
    bool answered_ = false;
    TimePoint free_at_;
};

TEST(Flight, FindsTheRateAndKeepsTheQueueShort) {
    for (const double rate : {1e6, 5e6, 50e6}) {
        SCOPED_TRACE(rate);
        Way way;
        way.bytes_per_second = rate;
        way.run(5);
        EXPECT_NEAR(way.flight.bytes_per_second(way.now), rate, 0.15 * rate);
        EXPECT_LT(way.queue(), 3 * Flight::allowed_queue(rate));
        const std::uint64_t before = way.total;
        way.run(5);
        EXPECT_GT(double(way.total - before), 5 * 0.8 * rate);
    }
}

TEST(Flight, FollowsARateThatFallsAndRises) {
    Way way;
    way.run(3);
    way.bytes_per_second = 1e6;
    way.run(1.5);
    EXPECT_NEAR(way.flight.bytes_per_second(way.now), 1e6, 0.2e6);
    EXPECT_LT(way.queue(), 3 * Flight::allowed_queue(1e6));
    way.bytes_per_second = 5e6;
    way.run(3);
    EXPECT_NEAR(way.flight.bytes_per_second(way.now), 5e6, 1e6);
}

TEST(Flight, APeerThatNeverAnswersIsNotHeldBack) {
    Flight flight;
    TimePoint now = from_us(1'000'000);
    for (int i = 0; i < 1000; ++i, now += 1ms) {
        EXPECT_TRUE(flight.may_send(now));
        flight.sent(chunk, now, true, now);
    }
    EXPECT_EQ(flight.take_delay(now), Duration(0));
}

TEST(Flight, APeerThatStopsAnsweringIsWaitedForAndShowsAsDelay) {
    Way way;
    way.run(2);
    way.flight.take_delay(way.now);
    EXPECT_FALSE(way.flight.may_send(way.now));
    EXPECT_GT(way.flight.take_delay(way.now + 2s), 1900ms);
}

TEST(Flight, AnswersThatCannotBeAreIgnored) {
    Flight flight;
    const TimePoint now = from_us(1'000'000);
    flight.sent(chunk, now, true, now);
    flight.acknowledge(chunk + 1, {}, now + 50ms);
    EXPECT_EQ(flight.bytes_on_the_way(), chunk);
    flight.acknowledge(chunk, {}, now + 50ms);
    flight.acknowledge(10, {}, now + 60ms);
    EXPECT_EQ(flight.bytes_on_the_way(), 0u);
    EXPECT_EQ(flight.round_trip(), 50ms);
}

// Without media, a peer acknowledges 8 KiB at once: half a second of one voice.
TEST(Flight, VoiceAloneIsNoSignOfASlowLink) {
    Flight flight;
    TimePoint now = from_us(1'000'000);
    std::uint64_t total = 0;
    flight.sent(chunk, now, true, now);
    total += chunk;
    now += 10ms;
    flight.acknowledge(total, {}, now);
    (void)flight.take_delay(now);
    for (int packet = 0; packet < 100; ++packet) {
        flight.sent_interaction(100, now);
        now += 20ms;
        EXPECT_EQ(flight.take_delay(now), Duration(0)) << packet;
    }
    flight.acknowledge(total + 100 * 100, {}, now);
    EXPECT_EQ(flight.take_delay(now), Duration(0));
    // A picture behind it counts.
    flight.sent_interaction(100, now);
    flight.sent(chunk, now, true, now);
    EXPECT_GE(flight.take_delay(now + 500ms), 490ms);
}

// A path that loses a packet now and then: what comes behind it is taken when it has been sent
// again. The sender sends pictures that fill four fifths of the path.
struct LosingWay {
    static constexpr double bytes_per_second = 5e6;
    static constexpr Duration one_way = 20ms, picture_every = 33ms, until_sent_again = 90ms;
    static constexpr std::size_t chunks_of_picture = 8;

    Flight flight;
    bool kernel_tells = true;
    Duration loses_every = 200ms;
    int refused = 0, sent = 0;
    Duration longest{};  // of a refusal
    TimePoint now = from_us(1'000'000);

    void run(double seconds) {
        TimePoint picture_at = now, loss_at = now + loses_every;
        std::size_t waiting = 0;
        std::optional<TimePoint> refused_since;
        for (const TimePoint end = now + seconds_to_duration(seconds); now < end; now += 500us) {
            if (now >= loss_at) {
                gap_until_ = now + until_sent_again;
                loss_at += loses_every;
            }
            while (!arriving_.empty() && arriving_.front().at <= now) {
                arrived_ = arriving_.front().total;
                arriving_.pop_front();
            }
            if (now >= gap_until_ && arrived_ > taken_) {
                sent_again_ += now - gap_until_ < 1ms;
                taken_ = arrived_;
                see();
                flight.acknowledge(taken_, {}, now + one_way);
            }
            if (now >= picture_at) {
                picture_at += picture_every;
                waiting = chunks_of_picture;  // a new picture replaces what waits of the last one
            }
            for (; waiting > 0 && may_send(); --waiting) {
                flight.sent(chunk, now, waiting == 1, now);
                total_ += chunk;
                ++sent;
                free_at_ =
                    std::max(free_at_, now) + seconds_to_duration(double(chunk) / bytes_per_second);
                arriving_.push_back({free_at_ + one_way, total_});
            }
            if (waiting == 0)
                flight.idle();
            if (waiting == 0 || !refused_since)
                refused_since = waiting > 0 ? std::optional(now) : std::nullopt;
            longest = std::max(longest, refused_since ? now - *refused_since : Duration(0));
        }
    }

private:
    struct Arrival {
        TimePoint at;
        std::uint64_t total;
    };

    bool see() {
        return kernel_tells &&
               flight.see({sent_again_, now < gap_until_ ? arrived_ - taken_ : 0, 0ms, 0, 100},
                          now);
    }
    bool may_send() { return flight.may_send(now) || (see() && flight.may_send(now)); }

    std::deque<Arrival> arriving_;
    std::uint64_t total_ = 0, arrived_ = 0, taken_ = 0;
    std::uint32_t sent_again_ = 0;
    TimePoint gap_until_, free_at_;
};

TEST(Flight, BytesBehindALostPacketNeitherFillTheWindowNorCountAsQueued) {
    LosingWay way;
    way.run(10);
    const auto all = int(LosingWay::chunks_of_picture * 10 / to_seconds(LosingWay::picture_every));
    EXPECT_GE(way.sent, all - 5);
    EXPECT_LT(way.longest, 10ms);
    const double rate = way.flight.bytes_per_second(way.now);
    EXPECT_TRUE(rate == 0 || rate > 0.8 * LosingWay::bytes_per_second) << rate;
}

// The same path where nothing is told: such a sender takes the link for a slow one. The test shows
// that the one above can fail.
TEST(Flight, WithoutTheKernelsWordALossLooksLikeASlowLink) {
    LosingWay way;
    way.kernel_tells = false;
    way.run(10);
    const auto all = int(LosingWay::chunks_of_picture * 10 / to_seconds(LosingWay::picture_every));
    EXPECT_LT(way.sent, all - 50);
}

// Packets are lost also by a link that is too slow: then the kernel sees the queue, and the rate.
TEST(Flight, AQueueThatTheKernelSeesGivesTheRateAlsoBehindAGap) {
    Flight flight;
    TimePoint now = from_us(1'000'000);
    std::uint64_t total = 0;
    std::uint32_t sent_again = 0;
    const auto picture = [&](Duration took) {
        for (int i = 0; i < 10; ++i) {
            flight.sent(chunk, now, i == 9, now);
            total += chunk;
        }
        now += took;
        flight.acknowledge(total, {}, now);
    };
    picture(40ms);
    for (int i = 0; i < 40; ++i) {
        EXPECT_FALSE(flight.see({++sent_again, 0, 60ms, 1e6, 100}, now));
        picture(150ms);
        flight.see({++sent_again, 0, 60ms, 1e6, 100}, now);
    }
    EXPECT_NEAR(flight.bytes_per_second(now), 1e6, 0.1e6);
}

// BBR lets four packets be in flight for 0.2 s, to see the round trip: the bytes wait in this
// kernel, and the path carries as much as before.
TEST(Flight, BbrsProbingIsNoSlowLink) {
    const TcpPath steady{0, 0, 0ms, 5e6, 100}, probing{0, 0, 0ms, 0.2e6, 4};
    for (const bool is_told : {true, false}) {
        Way way;
        way.run(3);
        const double before = way.flight.bytes_per_second(way.now);
        const TimePoint sent_at = way.now;
        std::uint64_t total = way.total;
        // Chunks that are in flight when the probe begins are taken one at a time.
        for (std::uint64_t taken = total - way.flight.bytes_on_the_way(); taken < total;) {
            taken = std::min(total, taken + chunk);
            way.now += 40ms;
            (void)way.flight.see(is_told ? probing : steady, way.now);
            way.flight.acknowledge(taken, {}, way.now);
            if (way.now - sent_at > 250ms)
                break;
        }
        const double after = way.flight.bytes_per_second(way.now);
        if (is_told)
            EXPECT_GT(after, 0.9 * before);
        else
            EXPECT_LT(after, 0.5 * before);
    }
}

// A path that needs no more than four packets in flight has that window for ever.
TEST(Flight, ASmallWindowOfASlowPathDoesNotHideItsRate) {
    Way way;
    way.bytes_per_second = 0.1e6;
    way.round_trip = 10ms;
    const TcpPath path{0, 0, 0ms, 0.1e6, 4};
    way.run(15);
    for (int i = 0; i < 50; ++i) {
        (void)way.flight.see(path, way.now);
        way.run(0.1);
    }
    EXPECT_NEAR(way.flight.bytes_per_second(way.now), 0.1e6, 0.02e6);
}

}  // namespace
}  // namespace theatron::net
