// SPDX-License-Identifier: Apache-2.0
// The address at which a host listens, and sentences on why it cannot.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>

#include "net/link.h"

namespace theatron::net {

// Throws Error with one sentence if it is no IP address: a name could be another machine's.
boost::asio::ip::address listen_address(const Endpoint& endpoint);

// One sentence about an error of opening the port.
std::string listening_problem(const Endpoint& endpoint, const boost::system::error_code& error);

}  // namespace theatron::net
