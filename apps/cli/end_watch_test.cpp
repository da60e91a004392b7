// SPDX-License-Identifier: Apache-2.0
#include "cli/end_watch.h"

#include <gtest/gtest.h>

namespace theatron::cli {
namespace {

constexpr TimePoint told{std::chrono::minutes(1)};

TEST(EndWatch, NothingIsEndedThatWasNotToldTo) {
    EndWatch watch;
    EXPECT_FALSE(watch.due());
    watch.begin_saving(30s);
    watch.end_saving(30s, told);
    EXPECT_FALSE(watch.due());
}

TEST(EndWatch, AProgramEndsWithinTwoSecondsOfBeingToldFirst) {
    EndWatch watch;
    watch.tell(told);
    watch.tell(told + 1s);
    EXPECT_EQ(watch.due(), told + 2s);
}

TEST(EndWatch, WhatIsSavedHasLonger) {
    EndWatch watch;
    watch.begin_saving(30s);
    watch.begin_saving(5s);
    watch.tell(told);
    EXPECT_EQ(watch.due(), told + 30s);
    watch.end_saving(30s, told + 3s);
    EXPECT_EQ(watch.due(), told + 8s) << "the other's";
    watch.end_saving(5s, told + 4s);
    EXPECT_EQ(watch.due(), told + 4500ms);
}

// A host that opens cameras for longer than its room needs: the end of that is not the end of the
// time.
TEST(EndWatch, WhatIsSavedAfterAnotherHasItsOwnTime) {
    EndWatch watch;
    watch.begin_saving(5s);
    watch.begin_saving(60s);
    watch.tell(told);
    watch.end_saving(60s, told + 20s);
    EXPECT_EQ(watch.due(), told + 25s);
    watch.end_saving(5s, told + 21s);
    EXPECT_EQ(watch.due(), told + 21500ms);
}

TEST(EndWatch, SavedBeforeItCostsNothing) {
    EndWatch watch;
    watch.begin_saving(30s);
    watch.end_saving(30s, told - 10s);
    watch.tell(told);
    EXPECT_EQ(watch.due(), told + 2s);
}

}  // namespace
}  // namespace theatron::cli
