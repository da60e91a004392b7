// SPDX-License-Identifier: Apache-2.0
#include "viewer/notice.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint begin(100s);

TEST(Notice, IsShownForSomeSeconds) {
    Notice notice;
    notice.begin(begin);
    EXPECT_EQ(notice.text(begin), "");
    notice.say("Ben calls", begin + 1s);
    EXPECT_EQ(notice.text(begin + 1s), "Ben calls");
    EXPECT_EQ(notice.text(begin + 5s), "Ben calls");
    EXPECT_EQ(notice.text(begin + 6s), "");
}

TEST(Notice, OfTheTimeBeforeTheFirstPictureIsShownForSomeSecondsOfThat) {
    Notice notice;
    notice.say("The depth codec 'zstf' does not exist", begin);
    EXPECT_EQ(notice.text(begin + 60s), "The depth codec 'zstf' does not exist");
    notice.begin(begin + 60s);
    EXPECT_EQ(notice.text(begin + 64s), "The depth codec 'zstf' does not exist");
    notice.begin(begin + 64s);
    EXPECT_EQ(notice.text(begin + 65s), "");
}

TEST(Notice, TheNewestReplacesTheOneBefore) {
    Notice notice;
    notice.begin(begin);
    notice.say("Ben calls", begin);
    notice.say("Ada calls", begin + 4s);
    EXPECT_EQ(notice.text(begin + 8s), "Ada calls");
    EXPECT_EQ(notice.text(begin + 9s), "");
}

TEST(Notice, ASentenceThatIsNotTrueAnyMoreGoes) {
    Notice notice;
    const TimePoint now{std::chrono::seconds(5)};
    notice.begin(now);
    notice.say("press at the other end", now);
    notice.take_back("another one");
    EXPECT_EQ(notice.text(now), "press at the other end");
    notice.take_back("press at the other end");
    EXPECT_EQ(notice.text(now), "");
}

}  // namespace
}  // namespace theatron::viewer
