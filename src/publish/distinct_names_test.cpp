// SPDX-License-Identifier: Apache-2.0
#include "publish/distinct_names.h"

#include <gtest/gtest.h>

namespace theatron::publish {
namespace {

using Names = std::vector<std::string>;

TEST(DistinctNames, NumberOnlyTheFurtherOnesOfTheSameName) {
    EXPECT_EQ(distinct_names({"scope", "tower"}), (Names{"scope", "tower"}));
    EXPECT_EQ(distinct_names({"scope", "tower", "scope", "scope"}),
              (Names{"scope", "tower", "scope (2)", "scope (3)"}));
}

TEST(DistinctNames, LeaveANameThatLooksNumberedToTheCameraThatHasIt) {
    EXPECT_EQ(distinct_names({"scope", "scope", "scope (2)"}),
              (Names{"scope", "scope (3)", "scope (2)"}));
}

}  // namespace
}  // namespace theatron::publish
