// SPDX-License-Identifier: Apache-2.0
#include "net/outgoing_proxy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::net {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::optional<OutgoingProxy> through(const std::string& proxy,
                                     const std::string& host = "or.example",
                                     const std::string& no_proxy = "") {
    return proxy_for(host, {proxy, no_proxy});
}

TEST(OutgoingProxy, IsReadFromItsVariable) {
    EXPECT_EQ(through(""), std::nullopt);
    EXPECT_EQ(through("  "), std::nullopt);
    const OutgoingProxy plain{"proxy.example", 8080, ""};
    for (const char* text : {"http://proxy.example:8080", "HTTP://proxy.example:8080/",
                             "proxy.example:8080", " proxy.example:8080 "})
        EXPECT_EQ(through(text), plain) << text;
    EXPECT_EQ(through("proxy.example")->port, 3128);
    EXPECT_EQ(through("http://[fd00::1]:80"), (OutgoingProxy{"fd00::1", 80, ""}));
    EXPECT_EQ(through("http://[fd00::1]:80")->where(), "[fd00::1]:80");
    EXPECT_EQ(through("http://ada:a%40b:c%3a@proxy.example:80"),
              (OutgoingProxy{"proxy.example", 80, "ada:a@b:c:"}));
    EXPECT_EQ(through("http://ada:100%@proxy.example:80")->credentials, "ada:100%");
}

TEST(OutgoingProxy, ASettingThatCannotBeUsedIsRefusedWithoutItsPassword) {
    for (const char* text :
         {"socks5://ada:secret@proxy:1080", "https://ada:secret@proxy:1", "http://ada:secret@",
          "http://ada:secret@proxy:0", "http://ada:secret@proxy:65536",
          "http://ada:secret@proxy:", "ada:secret@proxy:8x", "http://ada:secret@[",
          "http://ada:secret@[fd00::12", "http://ada:secret@[]:1", "http://ada:secret@[fd00::1]8"})
        try {
            (void)through(text);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("HTTPS_PROXY")) << text;
            EXPECT_THAT(error.what(), Not(HasSubstr("secret")));
        }
}

TEST(OutgoingProxy, IsNotAskedForThisComputerNorForWhatNoProxyNames) {
    const auto asks = [](const char* host, const char* no_proxy) {
        return through("proxy:1", host, no_proxy).has_value();
    };
    for (const char* own : {"localhost", "LOCALHOST", "127.0.0.1", "127.9.9.9", "::1", "0.0.0.0"})
        EXPECT_FALSE(asks(own, "")) << own;
    EXPECT_FALSE(asks("or.example", "*"));
    for (const char* same : {"or.example", ".example", "example", "EXAMPLE", "a, example ,b"}) {
        EXPECT_FALSE(asks("or.example", same)) << same;
        EXPECT_FALSE(asks("OR.Example", same)) << same;
    }
    for (const char* other : {"r.example", "ample", "or", "x.or.example", ",,", "or.example.org"})
        EXPECT_TRUE(asks("or.example", other)) << other;
    EXPECT_FALSE(asks("10.1.2.3", "10.0.0.0/8"));
    EXPECT_FALSE(asks("10.1.2.3", "example,10.1.2.3"));
    EXPECT_TRUE(asks("10.1.2.3", "11.0.0.0/8,10.1.2.0/33,10.1.2,fd00::/8,/"));
    EXPECT_FALSE(asks("fd00::5", "fd00::/64"));
    EXPECT_FALSE(asks("fd00::5", "[fd00:0::5]"));
    EXPECT_TRUE(asks("fd00::5", "fd01::/64,10.0.0.0/8"));
}

TEST(OutgoingProxy, IsAskedForATunnel) {
    EXPECT_EQ(tunnel_request({"proxy", 1, ""}, "or.example", 4400),
              "CONNECT or.example:4400 HTTP/1.1\r\nHost: or.example:4400\r\n\r\n");
    // RFC 7617, section 2.
    EXPECT_EQ(tunnel_request({"proxy", 1, "Aladdin:open sesame"}, "fd00::5", 1),
              "CONNECT [fd00::5]:1 HTTP/1.1\r\nHost: [fd00::5]:1\r\n"
              "Proxy-Authorization: Basic QWxhZGRpbjpvcGVuIHNlc2FtZQ==\r\n\r\n");
}

TEST(OutgoingProxy, NamesTheSchemesThatItOffers) {
    const auto offered = [](const char* field) { return offered_schemes(field); };
    EXPECT_THAT(offered("Basic realm=\"x\""), ElementsAre("Basic"));
    EXPECT_THAT(offered("Negotiate"), ElementsAre("Negotiate"));
    EXPECT_THAT(
        offered("Negotiate YII=, NTLM ,Digest realm = \"Basic , \\\"Basic\" , qop=auth,Basic"),
        ElementsAre("Negotiate", "NTLM", "Digest", "Basic"));
    EXPECT_THAT(offered("Basic\trealm=\"a, Negotiate"), ElementsAre("Basic"));
    for (const char* none : {"", " , ", "realm=x", "realm =x", "\"Basic\"", "Ba/sic", "\\"})
        EXPECT_THAT(offered(none), ElementsAre()) << none;
}

}  // namespace
}  // namespace theatron::net
