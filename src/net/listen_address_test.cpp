// SPDX-License-Identifier: Apache-2.0
#include "net/listen_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/asio/error.hpp>

#include "base/error.h"

namespace theatron::net {
namespace {

using ::testing::HasSubstr;
namespace errc = boost::system::errc;

std::string refusal(const std::string& address) {
    try {
        (void)listen_address({address, 1});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ListenAddress, OnlyIpAddressesAreListenedOn) {
    for (const char* address : {"0.0.0.0", "127.0.0.1", "::", "::1"})
        EXPECT_EQ(refusal(address), "") << address;
    for (const char* address : {"localhost", "*", "or-3.hospital.example", "\x1b[1m"}) {
        EXPECT_THAT(refusal(address), HasSubstr("write an IP address")) << address;
        EXPECT_EQ(refusal(address).find('\x1b'), std::string::npos);
    }
}

TEST(ListenAddress, EachProblemSaysWhatToDo) {
    const Endpoint https{"0.0.0.0", 443}, six{"::", 4400}, four{"10.0.0.1", 4400};
    EXPECT_EQ(listening_problem(four, boost::asio::error::address_in_use),
              "Port 4400 on 10.0.0.1 is in use; stop the other program or choose another port with "
              "--listen.");
    EXPECT_THAT(listening_problem(https, boost::asio::error::access_denied),
                HasSubstr("Port 443 on 0.0.0.0 may not be opened by this user"));
    EXPECT_THAT(listening_problem(four, errc::make_error_code(errc::address_not_available)),
                HasSubstr("'10.0.0.1' is no address of this machine now"));
    EXPECT_THAT(listening_problem(six, boost::asio::error::address_family_not_supported),
                HasSubstr("This machine has no IPv6"));
    EXPECT_THAT(listening_problem(four, boost::asio::error::address_family_not_supported),
                HasSubstr("This machine has no IPv4"));
    EXPECT_THAT(listening_problem(six, boost::asio::error::no_memory),
                HasSubstr("Cannot listen on [::]:4400: "));
}

}  // namespace
}  // namespace theatron::net
