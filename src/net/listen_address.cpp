// SPDX-License-Identifier: Apache-2.0
#include "net/listen_address.h"

#include <boost/asio/error.hpp>

#include "base/error.h"
#include "base/outside_text.h"

namespace theatron::net {
namespace {

constexpr std::size_t shown_characters = 80;

}  // namespace

boost::asio::ip::address listen_address(const Endpoint& endpoint) {
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(endpoint.address, error);
    if (error)
        throw Error(
            "'" + clean_text(endpoint.address, shown_characters) +
            "' is no address of this machine; write an IP address such as 0.0.0.0 or 127.0.0.1.");
    return address;
}

std::string listening_problem(const Endpoint& endpoint, const boost::system::error_code& error) {
    namespace errc = boost::system::errc;
    const std::string port = "Port " + std::to_string(endpoint.port) + " on " + endpoint.address;
    if (error == boost::asio::error::address_in_use)
        return port + " is in use; stop the other program or choose another port with --listen.";
    if (error == boost::asio::error::access_denied)
        return port +
               " may not be opened by this user: ports below 1024 need the right "
               "CAP_NET_BIND_SERVICE (docs/service.md); take a port from 1024 on, or give it.";
    if (error == errc::make_error_condition(errc::address_not_available))
        return "'" + endpoint.address +
               "' is no address of this machine now; 'ip address' lists those that it has, and "
               "0.0.0.0 means all of them.";
    if (error == boost::asio::error::address_family_not_supported)
        return "This machine has no IPv" +
               std::string(endpoint.address.find(':') == std::string::npos ? "4" : "6") +
               ", so it cannot listen on '" + endpoint.address +
               "'; write an address of the other kind.";
    return "Cannot listen on " + host_and_port(endpoint.address, endpoint.port) + ": " +
           error.message() + ".";
}

}  // namespace theatron::net
