// SPDX-License-Identifier: Apache-2.0
#include "net/flight.h"

#include <gtest/gtest.h>

#include <deque>

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

}  // namespace
}  // namespace theatron::net
