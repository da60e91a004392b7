// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace theatron::net {

// IPv4 addresses at which other machines may reach this one, at most `most`. Not in a browser.
std::vector<std::string> own_addresses(std::size_t most);

}  // namespace theatron::net
