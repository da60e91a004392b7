// SPDX-License-Identifier: Apache-2.0
#include "voice/microphone_feed.h"

#include <gtest/gtest.h>

#include <numeric>

namespace theatron::voice {
namespace {

struct Got {
    std::vector<std::size_t> sizes;
    std::vector<TimePoint> ends;
    std::vector<float> samples;
};

Got drain(MicrophoneFeed& feed) {
    Got got;
    feed.drain([&](std::span<const float> samples, TimePoint end) {
        got.sizes.push_back(samples.size());
        got.ends.push_back(end);
        got.samples.insert(got.samples.end(), samples.begin(), samples.end());
    });
    return got;
}

TEST(MicrophoneFeed, BlocksOfAnySizeComeInOrderWithTheirTimes) {
    MicrophoneFeed feed;
    float next = 0;
    std::size_t all = 0;
    for (int round = 0; round < 100; ++round) {
        std::vector<std::size_t> sizes;
        std::vector<TimePoint> ends;
        for (const std::size_t size : {std::size_t(441), std::size_t(1 + round * 7 % 960)}) {
            std::vector<float> block(size);
            std::iota(block.begin(), block.end(), next);
            next += float(size);
            all += size;
            sizes.push_back(size);
            ends.push_back(from_us(std::int64_t(all)));
            feed.take(block, ends.back());
        }
        const Got got = drain(feed);
        EXPECT_EQ(got.sizes, sizes);
        EXPECT_EQ(got.ends, ends);
        for (std::size_t i = 1; i < got.samples.size(); ++i)
            ASSERT_EQ(got.samples[i], got.samples[i - 1] + 1);
        ASSERT_EQ(got.samples.back() + 1, next);
    }
    EXPECT_EQ(feed.lost(), 0u);
}

TEST(MicrophoneFeed, ABlockWithoutRoomIsLostWholeAndCounted) {
    MicrophoneFeed feed;
    std::vector<float> block(1000);
    for (int i = 0; i < 30; ++i) {
        std::fill(block.begin(), block.end(), float(i));
        feed.take(block, from_us(i));
    }
    EXPECT_EQ(feed.lost(), 6000u);
    Got got = drain(feed);
    ASSERT_EQ(got.sizes.size(), 24u);
    EXPECT_EQ(got.ends.back(), from_us(23));
    EXPECT_EQ(got.samples.back(), 23.0f);
    // There is room again.
    feed.take(block, from_us(30));
    got = drain(feed);
    EXPECT_EQ(got.sizes, std::vector<std::size_t>{1000});
    EXPECT_EQ(got.ends, std::vector<TimePoint>{from_us(30)});
    // Very many small blocks are bounded, too.
    for (int i = 0; i < 2000; ++i)
        feed.take(std::span(block).first(1), from_us(i));
    EXPECT_EQ(feed.lost(), 6000u + 2000 - drain(feed).sizes.size());
}

}  // namespace
}  // namespace theatron::voice
