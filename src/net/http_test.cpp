// SPDX-License-Identifier: Apache-2.0
#include "net/http.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

TEST(Http, ReadsTheToken) {
    EXPECT_EQ(shown_token({"/status", "Bearer abc"}), "abc");
    EXPECT_EQ(shown_token({"/status?token=abc", ""}), "abc");
    EXPECT_EQ(shown_token({"/status?x=1&token=a%2Bb+c%2&y", ""}), "a+b c%2");
    EXPECT_EQ(shown_token({"/status?mytoken=abc&tokens=abc", ""}), "");
    EXPECT_EQ(shown_token({"/status", "Basic abc"}), "");
    EXPECT_EQ(shown_token({"", ""}), "");
}

TEST(Http, ThePathEndsWhereTheQueryBegins) {
    EXPECT_EQ(path_of("/connection?a=b?c"), "/connection");
    EXPECT_EQ(path_of("/connection"), "/connection");
    EXPECT_EQ(path_of(""), "");
}

TEST(Http, AnEncodingIsAcceptedByItsNameUnlessItsWeightIsZero) {
    for (const char* text : {"br", "gzip, deflate, br", "gzip;q=0.5,br;q=0.01", " br ; q=1"})
        EXPECT_TRUE(accepts_encoding(text, "br")) << text;
    for (const char* text : {"", "*", "brotli", "gzip", "br;q=0", "br; q=0.000", ",,;", "gzip;br"})
        EXPECT_FALSE(accepts_encoding(text, "br")) << text;
}

TEST(Http, OnlyPagesOfTheHostItselfAreItsOwn) {
    EXPECT_TRUE(is_own_origin("", "or-3:4400"));
    EXPECT_TRUE(is_own_origin("https://or-3:4400", "or-3:4400"));
    for (const char* origin : {"https://elsewhere", "http://or-3:4400", "null", "https://or-3:44",
                               "https://or-3:4400.elsewhere"})
        EXPECT_FALSE(is_own_origin(origin, "or-3:4400")) << origin;
}

}  // namespace
}  // namespace theatron::net
