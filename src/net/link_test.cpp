// SPDX-License-Identifier: Apache-2.0
#include "net/link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::net {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string problem_with(const std::string& text) {
    try {
        parse_link(text);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(Link, WhatIsSaidAboutAWrongOneNeverHoldsItsToken) {
    const std::string token = "0123456789abcdef0123456789abcdef";
    for (const std::string& text :
         {"https://or3:4400/#join=" + token, "https://or3:4400/join=" + token,
          "http://or3:4400/#join=" + token + "&cert=12", "https://or3/#join=" + token,
          "https://or3:4400/?token=" + token, "join=" + token, token,
          "https://or3:4400/#" + token}) {
        EXPECT_THAT(problem_with(text), HasSubstr("copy the whole link")) << text;
        EXPECT_THAT(problem_with(text), Not(HasSubstr(token.substr(0, 8)))) << text;
    }
}

TEST(Link, WhatIsSaidAboutAWrongOneShowsItsHost) {
    EXPECT_THAT(problem_with("https://or3:4400/#join=secret"),
                HasSubstr("'https://or3:4400/...' carries no certificate fingerprint"));
    EXPECT_THAT(problem_with("localhost:4400"),
                HasSubstr("'localhost:4400' does not begin with https://"));
    EXPECT_THAT(problem_with("\033[31m"), HasSubstr("'?[31m'"));
    EXPECT_LT(problem_with("http://" + std::string(100'000, 'x')).size(), 200u);
}

TEST(Link, HostAndPortHaveIpv6InBrackets) {
    EXPECT_EQ(host_and_port("or-3.example", 4400), "or-3.example:4400");
    EXPECT_EQ(host_and_port("10.1.2.3", 4400), "10.1.2.3:4400");
    EXPECT_EQ(host_and_port(Link{"2001:db8::7", 4400, "", ""}), "[2001:db8::7]:4400");
}

TEST(Link, NamesAHostThatParsesBack) {
    for (const char* host : {"or-3.hospital.example", "OR_3", "10.1.2.3", "fd00::1", "::1"}) {
        EXPECT_TRUE(can_be_linked(host)) << host;
        const Link link = {host, 4400, "0123456789abcdef", std::string(64, 'a')};
        EXPECT_EQ(parse_link(format_link(link)).host, host);
    }
    for (const std::string& host : {std::string(400, 'a'), std::string("::1\0", 4)})
        EXPECT_FALSE(can_be_linked(host)) << host;
    for (const char* host : {"", ":", "1:2", "1.2.3.4:99", "a b", "a/b", "or-3:4400", "[::1]",
                             "a#b", "a@b", ".a", "-a", "a\nb", "https://a", "\xc3\xa9"})
        EXPECT_FALSE(can_be_linked(host)) << host;
}

}  // namespace
}  // namespace theatron::net
