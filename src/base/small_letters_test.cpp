// SPDX-License-Identifier: Apache-2.0
#include "base/small_letters.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

TEST(SmallLetters, OnlyAsciiLettersChange) {
    EXPECT_EQ(in_small_letters("AZ-az@[`{09 \xc3\x84"), "az-az@[`{09 \xc3\x84");
}

TEST(SmallLetters, TextsAreEqualWithoutCase) {
    EXPECT_TRUE(equal_without_case("Content-Length", "CONTENT-length"));
    EXPECT_TRUE(equal_without_case("", ""));
    EXPECT_FALSE(equal_without_case("Content", "Content-"));
    EXPECT_FALSE(equal_without_case("@", "`"));
}

}  // namespace
}  // namespace theatron
