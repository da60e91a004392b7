// SPDX-License-Identifier: Apache-2.0
#include "net/delay_line.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

Bytes envelope(int number) {
    return Bytes(3, std::byte(number));
}

TEST(DelayLine, EnvelopesLeaveInTheirOrderWhenTheirTimeHasCome) {
    DelayLine line;
    EXPECT_FALSE(line.is_used());
    line.set_delay(80ms);
    EXPECT_TRUE(line.is_used());
    const TimePoint start = from_us(5'000'000);
    line.push(envelope(1), start);
    line.push(envelope(2), start + 10ms);
    EXPECT_EQ(line.bytes(), 6u);
    EXPECT_EQ(line.due(), start + 80ms);
    EXPECT_EQ(line.take(start + 79ms), std::nullopt);
    EXPECT_EQ(line.take(start + 80ms), envelope(1));
    EXPECT_EQ(line.take(start + 80ms), std::nullopt);
    EXPECT_EQ(line.take(start + 90ms), envelope(2));
    EXPECT_EQ(line.due(), std::nullopt);
    EXPECT_EQ(line.bytes(), 0u);
}

TEST(DelayLine, NothingOvertakesWhatWaitsWhenTheDelayEnds) {
    DelayLine line;
    line.set_delay(80ms);
    const TimePoint start = from_us(5'000'000);
    line.push(envelope(1), start);
    line.set_delay(0ms);
    EXPECT_TRUE(line.is_used()) << "one still waits";
    line.push(envelope(2), start + 1ms);
    EXPECT_EQ(line.take(start + 79ms), std::nullopt);
    EXPECT_EQ(line.take(start + 80ms), envelope(1));
    EXPECT_EQ(line.take(start + 80ms), envelope(2));
    EXPECT_FALSE(line.is_used());
}

TEST(DelayLine, TheLastOnesLeaveAtOnceAndNothingElseDoes) {
    DelayLine line;
    line.set_delay(5s);
    const TimePoint start = from_us(5'000'000);
    for (int number = 1; number <= 4; ++number)
        line.push(envelope(number), start);
    line.hurry([](ByteView one) { return int(one[0]) % 2 == 0; });
    EXPECT_EQ(line.bytes(), 6u);
    line.push(envelope(5), start);
    for (const int number : {2, 4, 5})
        EXPECT_EQ(line.take(start), envelope(number));
    EXPECT_FALSE(line.is_used());
}

}  // namespace
}  // namespace theatron::net
