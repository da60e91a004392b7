// SPDX-License-Identifier: Apache-2.0
#include "net/http.h"

#include <gtest/gtest.h>

#include "base/error.h"

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

TEST(Http, AGuessIsOneWhereverTheTokenStands) {
    const HttpAnswer refused{.status = 401}, answered{.status = 200};
    for (const HttpRequest& request :
         {HttpRequest{"/status", "Bearer abc"}, HttpRequest{"/status", "Basic abc"},
          HttpRequest{"/status?token=abc", ""}, HttpRequest{"/lobby?x=1&token=abc", ""}}) {
        EXPECT_TRUE(is_wrong_guess(request, refused)) << request.target;
        EXPECT_FALSE(is_wrong_guess(request, answered)) << request.target;
    }
    EXPECT_FALSE(is_wrong_guess({"/status", ""}, refused)) << "nothing is guessed";
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

TEST(Http, APublicNameHasAPortOrTheUsualOne) {
    EXPECT_EQ(parse_public_name("OR-3.Hospital.example", 443).name, "or-3.hospital.example");
    EXPECT_EQ(parse_public_name("or-3", 443).port, 443);
    EXPECT_EQ(parse_public_name("10.1.2.3:8443", 443).port, 8443);
    EXPECT_EQ(origin_of({"or-3", 443}), "https://or-3");
    EXPECT_EQ(origin_of({"or-3", 8443}), "https://or-3:8443");
    for (const char* text : {"", ":443", "or-3:", "or-3:0", "or-3:65536", "or-3:44x", "or 3",
                             "https://or-3", "or-3/", "[::1]", ".or-3", "or-3:1:2"})
        EXPECT_THROW(parse_public_name(text, 443), Error) << text;
}

TEST(Http, AHostIsNamedByItsPublicNameOrAnAddress) {
    for (const char* host :
         {"or-3.example", "OR-3.Example", "or-3.example:443", "or-3.example.", "or-3.example.:4400",
          "localhost:4400", "127.0.0.1", "10.1.2.3:4400", "[::1]", "[fd00::1]:4400"})
        EXPECT_TRUE(is_named(host, "or-3.example")) << host;
    for (const char* host : {"", ":", ":443", "or-3", "evil.example", "or-3.example.evil.example",
                             "or-3.example@evil.example", "or-3.example:443.evil.example", "[",
                             "[]x", "[evil.example]", "1.2.3", "127.0.0.1.evil.example",
                             "or-3.example:4 4", "or-3.example..", "user:or-3.example"})
        EXPECT_FALSE(is_named(host, "or-3.example")) << host;
}

}  // namespace
}  // namespace theatron::net
