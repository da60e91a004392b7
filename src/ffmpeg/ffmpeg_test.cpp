// SPDX-License-Identifier: Apache-2.0
#include "ffmpeg/ffmpeg.h"

#include <gtest/gtest.h>

extern "C" {
#include <libavutil/mathematics.h>
#include <libavutil/md5.h>
}

#include <array>

namespace theatron::ffmpeg {
namespace {

TEST(Ffmpeg, LoadedFunctionsGetTheirArgumentsAndReturnTheirResults) {
    if (!problem().empty())
        GTEST_SKIP() << problem();
    // Structures by value, and a large integer.
    EXPECT_EQ(av_rescale_q(1'000'000'000'000, {1, 1000}, {1, 90000}), 90'000'000'000'000);
    std::array<std::uint8_t, 16> sum{};
    const std::uint8_t text[] = {'a', 'b', 'c'};
    av_md5_sum(sum.data(), text, sizeof(text));
    EXPECT_EQ(sum[0], 0x90);
    EXPECT_EQ(sum[15], 0x72);
}

TEST(FfmpegDeathTest, ACallBeforeTheLibrariesAreLoadedNamesTheMistake) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process in which nothing is loaded
    std::uint8_t sum[16];
    EXPECT_DEATH(av_md5_sum(sum, sum, 1), "before its libraries were loaded");
}

}  // namespace
}  // namespace theatron::ffmpeg
