// SPDX-License-Identifier: Apache-2.0
// Names of a publisher's cameras by which a session can tell them apart.
#pragma once

#include <string>
#include <vector>

namespace theatron::publish {

// The names in their order; the second of the same ones ends with " (2)" and so on.
std::vector<std::string> distinct_names(std::vector<std::string> names);

}  // namespace theatron::publish
