// SPDX-License-Identifier: Apache-2.0
#include "net/proxies.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::net {
namespace {

const Proxies proxies({"127.0.0.1", "10.1.0.0/16", "fd00:1::/32"});

TEST(Proxies, AreKnownByAddressOrNetwork) {
    for (const char* address : {"127.0.0.1", "::ffff:127.0.0.1", "10.1.0.0", "10.1.255.255",
                                "::ffff:10.1.2.3", "fd00:1::5"})
        EXPECT_TRUE(proxies.contains(address)) << address;
    for (const char* address :
         {"127.0.0.2", "10.2.0.0", "10.0.255.255", "::1", "fd00:2::5", "::10.1.2.3", "", "10.1"})
        EXPECT_FALSE(proxies.contains(address)) << address;
    EXPECT_FALSE(Proxies().contains("127.0.0.1"));
}

TEST(Proxies, TheLastAddressThatIsNoProxyIsTheClient) {
    EXPECT_EQ(proxies.client_of("192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(proxies.client_of("192.0.2.7, 10.1.2.3,127.0.0.1"), "192.0.2.7");
    EXPECT_EQ(proxies.client_of(" 2001:db8:0::7\t"), "2001:db8::7");
    EXPECT_EQ(proxies.client_of("::ffff:192.0.2.7"), "192.0.2.7");
}

TEST(Proxies, WhatAClientInventedStandsBeforeItsAddressAndIsNotRead) {
    EXPECT_EQ(proxies.client_of("198.51.100.1, 192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(proxies.client_of("nonsense\"[,192.0.2.7, 10.1.2.3"), "192.0.2.7");
    EXPECT_EQ(proxies.client_of("127.0.0.1, 192.0.2.7"), "192.0.2.7");
}

TEST(Proxies, SomeWriteAPortBracketsOrQuotes) {
    EXPECT_EQ(proxies.client_of("192.0.2.7:51234"), "192.0.2.7");
    EXPECT_EQ(proxies.client_of("[2001:db8::7]:51234"), "2001:db8::7");
    EXPECT_EQ(proxies.client_of("\"[2001:db8::7]\""), "2001:db8::7");
}

TEST(Proxies, WhereAllAreProxiesSomebodyOnTheFirstOneIsTheClient) {
    EXPECT_EQ(proxies.client_of("127.0.0.1"), "127.0.0.1");
    EXPECT_EQ(proxies.client_of("10.1.0.9, 127.0.0.1"), "10.1.0.9");
}

TEST(Proxies, WithoutAClientThereIsNone) {
    for (const char* text : {"", ",", " ", ",127.0.0.1", "unknown, 127.0.0.1", "unknown", "192.0.2",
                             "192.0.2.7, nonsense", "192.0.2.7,", "[", "[]", "\"", ":",
                             "fe80::1%lo", "192.0.2.7 192.0.2.8"})
        EXPECT_FALSE(proxies.client_of(text)) << text;
    EXPECT_EQ(Proxies().client_of("127.0.0.1"), "127.0.0.1");
}

TEST(Proxies, WhatIsNoAddressOrTooWideANetworkIsRefused) {
    for (const char* text :
         {"", "proxy.example", "10.1.0.0/33", "10.1.0.0/", "10.1.0.0/x", "0.0.0.0/0", "10.0.0.0/7",
          "::/0", "fd00::/129", "fe80::1%lo", "127.0.0.1,10.0.0.1"})
        EXPECT_THROW(Proxies({text}), Error) << text;
}

}  // namespace
}  // namespace theatron::net
