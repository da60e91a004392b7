// SPDX-License-Identifier: Apache-2.0
#include "session/ipv4_network.h"

#include <gtest/gtest.h>

namespace theatron::session {
namespace {

TEST(Ipv4Network, ContainsTheAddressesThatShareItsLeadingBits) {
    const auto contains = [](const char* network, const char* address) {
        return parse_ipv4_network(network).value().contains(parse_ipv4(address).value());
    };
    EXPECT_TRUE(contains("10.2.0.0/16", "10.2.255.1"));
    EXPECT_FALSE(contains("10.2.0.0/16", "10.3.0.1"));
    EXPECT_TRUE(contains("10.2.3.4", "10.2.3.4"));
    EXPECT_FALSE(contains("10.2.3.4", "10.2.3.5"));
    EXPECT_TRUE(contains("0.0.0.0/0", "255.255.255.255"));
    EXPECT_TRUE(contains("192.168.7.1/31", "192.168.7.0"));
}

TEST(Ipv4Network, AnythingElseIsNone) {
    for (const char* text :
         {"", "10", "10.2.0", "10.2.0.0.1", "10.2.0.256", "10.2.0.-1", "010.2.0.0", "10.2.0.0/",
          "10.2.0.0/33", "10.2.0.0/-1", "10.2.0.0/016", "10.2.0.0/16 ", " 10.2.0.0", "::1", "host",
          "10.2.0.0/16/8", "10..0.1"})
        EXPECT_FALSE(parse_ipv4_network(text)) << text;
}

}  // namespace
}  // namespace theatron::session
