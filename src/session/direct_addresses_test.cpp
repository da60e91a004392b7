// SPDX-License-Identifier: Apache-2.0
#include "session/direct_addresses.h"

#include <gtest/gtest.h>

#include "session/direct_pace.h"

namespace theatron::session {
namespace {

using namespace std::chrono_literals;
using AddressTexts = std::vector<std::string>;

// Everything that a publisher with bad intentions may think of.
const AddressTexts hostile_addresses{"0.0.0.0",
                                     "0.1.2.3",
                                     "::",
                                     "::1",
                                     "::ffff:127.0.0.1",
                                     "::ffff:7f00:1",
                                     "::ffff:127.9.8.7",
                                     "127.0.0.5",
                                     "127.1",
                                     "2130706433",
                                     "0x7f.0.0.1",
                                     "0177.0.0.1",
                                     "169.254.169.254",
                                     "224.0.0.1",
                                     "239.255.255.250",
                                     "240.0.0.1",
                                     "255.255.255.255",
                                     "198.51.100.7",
                                     "fe80::1",
                                     "2001:db8::1",
                                     "ff02::1",
                                     "1.1",
                                     "host.example",
                                     "10.0.0.5 ",
                                     "10.0.0.5:80",
                                     "10.0.0.05",
                                     "10.0.0.256",
                                     "10.0.0",
                                     ""};

TEST(DirectAddresses, AreThoseOfThePublishersOwnNetworks) {
    EXPECT_EQ(direct_addresses("10.1.0.5", {"10.1.7.5", "10.2.0.5", "192.168.1.5", "10.1.0.5"},
                               "10.1.0.9"),
              (AddressTexts{"10.1.0.5", "10.1.7.5"}));
    EXPECT_EQ(direct_addresses("::ffff:10.1.0.5", {"::ffff:10.1.7.5"}, "192.168.3.3"),
              (AddressTexts{"10.1.0.5", "10.1.7.5"}))
        << "routed between two local networks";
    EXPECT_EQ(direct_addresses("169.254.3.4", {"169.254.3.5"}, "169.254.8.8"),
              (AddressTexts{"169.254.3.4"}))
        << "a cable without a router";
}

TEST(DirectAddresses, NobodyIsSentToMachinesOfOthers) {
    for (const char* publisher : {"10.1.0.5", "203.0.113.5", "169.254.3.4", "somewhere", ""})
        for (const char* receiver : {"10.1.0.9", "203.0.113.9", "127.0.0.1", ""})
            for (const std::string& address :
                 direct_addresses(publisher, hostile_addresses, receiver))
                EXPECT_EQ(address, publisher) << "for " << receiver;
    // On a receiver's way through the internet there is another machine of this address.
    EXPECT_EQ(direct_addresses("10.1.0.5", {"10.1.7.5"}, "203.0.113.9"), AddressTexts{});
    EXPECT_EQ(direct_addresses("10.1.0.5", {"10.1.7.5"}, ""), AddressTexts{});
}

TEST(DirectAddresses, OnTheInternetOnlyTheOneThatTheHostSees) {
    EXPECT_EQ(direct_addresses("203.0.113.5", {"192.168.1.5", "203.0.113.6"}, "203.0.113.9"),
              AddressTexts{"203.0.113.5"});
    EXPECT_EQ(direct_addresses("203.0.113.5", {"192.168.1.5"}, "203.0.113.5"),
              (AddressTexts{"203.0.113.5", "192.168.1.5"}))
        << "behind one router";
}

TEST(DirectAddresses, OnTheHostsMachineItsNetworksAreThePublishers) {
    EXPECT_EQ(direct_addresses("127.0.0.1", {"10.1.7.5", "127.0.0.5"}, "127.0.0.1"),
              (AddressTexts{"127.0.0.1", "127.0.0.5"}));
    EXPECT_EQ(direct_addresses("127.0.0.1", {"10.1.7.5", "192.168.1.5"}, "10.1.0.9"),
              AddressTexts{"10.1.7.5"});
    EXPECT_EQ(direct_addresses("10.1.0.5", {"127.0.0.1"}, "127.0.0.1"), AddressTexts{"10.1.0.5"});
}

TEST(DirectPace, BelongsToThePublisherWhateverGrantsComeAndGo) {
    DirectPace pace(1s, 30s);
    TimePoint now = from_us(1'000'000'000);
    EXPECT_EQ(pace.wait(now), 0s);
    // Each grant is withdrawn at once, and a new one comes five times a second.
    int attempts = 0;
    for (const TimePoint end = now + 60s; now < end; now += 200ms)
        if (pace.wait(now) == 0s) {
            pace.on_attempt(now);
            ++attempts;
        }
    EXPECT_LE(attempts, 6);
    now += 60s;
    pace.on_attempt(now);
    now += 1h;
    pace.on_end(now, true);
    EXPECT_EQ(pace.wait(now), 1s) << "a way that works is tried again soon";
}

TEST(DirectPace, WaitsLongerAfterEachFailure) {
    DirectPace pace(1s, 30s);
    TimePoint now = from_us(1'000'000'000);
    Duration pause = 1s;
    for (int i = 0; i < 8; ++i) {
        pace.on_attempt(now);
        now += 2s;
        pace.on_end(now, false);
        EXPECT_EQ(pace.wait(now), pause);
        now += pause;
        pause = std::min(2 * pause, Duration(30s));
    }
    EXPECT_FALSE(pace.is_over(now));
    EXPECT_TRUE(pace.is_over(now + 1min));
}

}  // namespace
}  // namespace theatron::session
