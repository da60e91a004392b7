// SPDX-License-Identifier: Apache-2.0
#include "data_url.h"

#include <gtest/gtest.h>

namespace theatron::bench {
namespace {

std::string base64_of(const std::string& text) {
    return base64(as_bytes(text));
}

TEST(DataUrl, Base64IsAsTheStandardsExamples) {
    EXPECT_EQ(base64_of(""), "");
    EXPECT_EQ(base64_of("f"), "Zg==");
    EXPECT_EQ(base64_of("fo"), "Zm8=");
    EXPECT_EQ(base64_of("foo"), "Zm9v");
    EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
    EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64_of("\xfb\xff\xfe"), "+//+");
}

TEST(DataUrl, APictureIsAJpeg) {
    ColorImage picture({16, 8});
    EXPECT_TRUE(picture_url(picture).starts_with("data:image/jpeg;base64,/9j/"));
}

}  // namespace
}  // namespace theatron::bench
