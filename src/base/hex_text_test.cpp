// SPDX-License-Identifier: Apache-2.0
#include "base/hex_text.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

TEST(HexText, ReadsItsOwnTextsOnly) {
    const Bytes bytes{std::byte{0}, std::byte{0x7f}, std::byte{0xa0}};
    EXPECT_EQ(hex_text(bytes), "007fa0");
    EXPECT_EQ(bytes_of_hex("007fa0"), bytes);
    EXPECT_EQ(bytes_of_hex(""), Bytes());
    for (const char* wrong : {"0", "0g", "7F", " 7", "0x7f"})
        EXPECT_FALSE(bytes_of_hex(wrong)) << wrong;
}

}  // namespace
}  // namespace theatron
