// SPDX-License-Identifier: Apache-2.0
#include "net/acknowledger.h"

#include <gtest/gtest.h>

#include <deque>

#include "net/flight.h"

namespace theatron::net {
namespace {

TEST(Acknowledger, AcknowledgesMediaSoonButNotEveryChunk) {
    Acknowledger acknowledger;
    TimePoint now = from_us(1'000'000);
    int acknowledged = 0;
    std::uint64_t taken = 0;
    for (int i = 1; i <= 1000; ++i, now += 100us) {
        acknowledger.came(16'000, true, now);
        if (const auto acknowledgement = acknowledger.due(now)) {
            ++acknowledged;
            taken = acknowledgement->taken;
            EXPECT_EQ(acknowledgement->held, Duration(0));
        }
    }
    EXPECT_GE(acknowledged, 24);
    EXPECT_LE(acknowledged, 26);
    // Nothing more comes: the rest is acknowledged in time, with the time that it waited.
    ASSERT_TRUE(acknowledger.ask_again());
    const TimePoint then = *acknowledger.ask_again();
    EXPECT_LE(then - now, Acknowledger::interval);
    const auto acknowledgement = acknowledger.due(then);
    ASSERT_TRUE(acknowledgement);
    EXPECT_GT(acknowledgement->taken, taken);
    EXPECT_EQ(acknowledgement->taken, 16'000'000u);
    EXPECT_EQ(acknowledgement->held, then - (now - 100us));
    EXPECT_FALSE(acknowledger.due(then + 1s));
    EXPECT_FALSE(acknowledger.ask_again());
}

TEST(Acknowledger, SmallMessagesAreAcknowledgedTogether) {
    Acknowledger acknowledger;
    TimePoint now = from_us(1'000'000);
    std::uint64_t received = 0, acknowledged = 0;
    for (int i = 0; i < 1000; ++i, now += 11ms) {
        acknowledger.came(100, false, now);
        received += 100;
        EXPECT_FALSE(acknowledger.ask_again());
        if (const auto acknowledgement = acknowledger.due(now))
            acknowledged = acknowledgement->taken;
        EXPECT_LT(received - acknowledged, wire::max_untold);
    }
    EXPECT_GT(acknowledged, 0u);
}

TEST(Acknowledger, MessagesThatWaitForADecoderAreNotAcknowledged) {
    Acknowledger acknowledger;
    TimePoint now = from_us(1'000'000);
    acknowledger.came(10'000, true, now);
    acknowledger.waits(9'991);
    ASSERT_TRUE(acknowledger.due(now));  // the header of the chunk was taken
    acknowledger.came(50'000, true, now += 1s);
    acknowledger.waits(49'991);
    const auto acknowledgement = acknowledger.due(now);
    EXPECT_LT(acknowledgement ? acknowledgement->taken : 0, 100u);
    acknowledger.taken(9'991, now += 1s);
    EXPECT_EQ(acknowledger.due(now)->taken, 10'009u);
    acknowledger.taken(49'991, now += 1s);
    EXPECT_EQ(acknowledger.due(now)->taken, 60'000u);
}

// A sender with a window and a viewer whose decoder needs longer than pictures take to come.
struct SlowDecoder {
    Flight flight;
    Acknowledger acknowledger;
    TimePoint now = from_us(1'000'000);
    Duration decode_time = 50ms;
    std::size_t picture = 100'000;
    std::size_t waiting = 0, most_waiting = 0;
    int decoded = 0;

    void run(double seconds) {
        std::size_t left = picture;
        for (const TimePoint end = now + seconds_to_duration(seconds); now < end; now += 500us) {
            while (flight.may_send(now) && (sent_ < picture || heard_)) {
                const std::size_t chunk = std::min<std::size_t>(left, 16'000);
                left -= chunk;
                flight.sent(chunk, now, left == 0, now);
                sent_ += chunk;
                acknowledger.came(chunk, true, now);
                if (left > 0)
                    continue;
                left = picture;
                acknowledger.waits(picture);
                queue_.push_back(picture);
                waiting += picture;
                most_waiting = std::max(most_waiting, waiting);
            }
            if (!queue_.empty() && now >= free_at_) {
                acknowledger.taken(queue_.front(), now);
                waiting -= queue_.front();
                queue_.pop_front();
                free_at_ = now + decode_time;
                ++decoded;
            }
            if (const auto acknowledgement = acknowledger.due(now)) {
                heard_ = true;
                flight.acknowledge(acknowledgement->taken, acknowledgement->held, now);
            }
        }
    }

private:
    std::deque<std::size_t> queue_;
    std::uint64_t sent_ = 0;
    bool heard_ = false;
    TimePoint free_at_;
};

TEST(Acknowledger, AViewerThatDecodesSlowlyHasLittleWaitingAndIsAlwaysBusy) {
    SlowDecoder viewer;
    viewer.run(2);
    viewer.most_waiting = 0;
    viewer.decoded = 0;
    viewer.run(10);
    EXPECT_LE(viewer.most_waiting, 4 * viewer.picture);
    EXPECT_GE(viewer.decoded, 195) << "of 200 that it has time for";
}

TEST(Acknowledger, APictureLargerThanTheWindowGetsThrough) {
    SlowDecoder viewer;
    viewer.decode_time = 200ms;
    viewer.picture = 4'000'000;
    viewer.run(20);
    EXPECT_GE(viewer.decoded, 90);
}

}  // namespace
}  // namespace theatron::net
