// SPDX-License-Identifier: Apache-2.0
#include "base/spsc_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <thread>

namespace theatron {
namespace {

TEST(SpscRing, KeepsTheOrderAndTakesWhatHasRoom) {
    SpscRing<int> ring(5);
    int next = 0, expected = 0;
    // Blocks of sizes that do not divide the ring's reach each place of it.
    for (int round = 0; round < 40; ++round) {
        std::vector<int> block(std::size_t(1 + round % 7));
        std::iota(block.begin(), block.end(), next);
        const std::size_t room = ring.room(), count = ring.put(block);
        EXPECT_EQ(count, std::min(room, block.size()));
        next += int(count);
        std::vector<int> out(std::size_t(1 + round % 3), -1);
        const std::size_t taken = ring.take(out);
        for (std::size_t i = 0; i < taken; ++i)
            EXPECT_EQ(out[i], expected++);
        for (std::size_t i = taken; i < out.size(); ++i)
            EXPECT_EQ(out[i], -1);
    }
    std::array<int, 8> rest{};
    EXPECT_EQ(int(ring.take(rest)), next - expected);
    EXPECT_EQ(ring.room(), ring.capacity());
    EXPECT_EQ(ring.take(rest), 0u);
}

TEST(SpscRing, TwoThreadsLoseNothing) {
    constexpr int all = 200'000;
    SpscRing<int> ring(64);
    std::thread putting([&] {
        for (int next = 0; next < all;) {
            const std::array<int, 3> block{next, next + 1, next + 2};
            const std::size_t count =
                ring.put(std::span(block).first(std::size_t(std::min(3, all - next))));
            next += int(count);
            if (count == 0)
                std::this_thread::yield();
        }
    });
    int expected = 0;
    bool in_order = true;
    while (expected < all) {
        std::array<int, 5> out{};
        const std::size_t count = ring.take(out);
        for (std::size_t i = 0; i < count; ++i)
            in_order = in_order && out[i] == expected++;
        if (count == 0)
            std::this_thread::yield();
    }
    putting.join();
    EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace theatron
