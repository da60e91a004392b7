// SPDX-License-Identifier: Apache-2.0
#include "base/machine_load.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

MachineTimes times(std::string_view stat) {
    return parse_machine_times(stat).value_or(MachineTimes{});
}

TEST(MachineLoad, IsTheShareOfThreadsWithTheUsualPriorityAndOfTheSystem) {
    const MachineTimes before = times("cpu  100 0 50 1000 10 0 0 0 0 0\ncpu0 1 2 3");
    const MachineTimes now = times("cpu  130 0 60 1050 18 1 1 0 0 0\n");
    EXPECT_DOUBLE_EQ(busy_share(before, now), 0.42);
}

TEST(MachineLoad, DoesNotCountThreadsThatMakeRoom) {
    const MachineTimes before = times("cpu  100 500 50 1000 10 0 0 0 0 0");
    const MachineTimes now = times("cpu  110 590 50 1000 10 0 0 0 0 0");
    EXPECT_DOUBLE_EQ(busy_share(before, now), 0.1);
}

TEST(MachineLoad, IsNoneWhereNothingPassedOrNothingIsKnown) {
    const MachineTimes same = times("cpu  100 500 50 1000 10 0 0 0 0 0");
    EXPECT_EQ(busy_share(same, same), 0);
    for (const char* text :
         {"", "cpu", "cpu 1 2 3 4 5 6 7", "intr 1 2 3 4 5 6 7 8", "cpu a b c d e f g h"})
        EXPECT_FALSE(parse_machine_times(text)) << text;
}

}  // namespace
}  // namespace theatron
