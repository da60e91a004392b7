// SPDX-License-Identifier: Apache-2.0
#include "visit/leaving.h"

#include <gtest/gtest.h>

namespace theatron::visit {
namespace {

TEST(Leaving, TakesTwoPressesInASessionAndOneOutsideOfIt) {
    const TimePoint start{};
    Leaving leaving;
    EXPECT_FALSE(leaving.pressed(true, start));
    EXPECT_TRUE(leaving.pressed(true, start + 2s));
    Leaving slow;
    EXPECT_FALSE(slow.pressed(true, start));
    EXPECT_FALSE(slow.pressed(true, start + 3s)) << "the first press is forgotten";
    EXPECT_TRUE(slow.pressed(true, start + 4s));
    EXPECT_TRUE(Leaving().pressed(false, start));
}

}  // namespace
}  // namespace theatron::visit
