// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace theatron::bench {

// Processes and sockets that this thread begins from now on are in the network namespace of this
// name; nothing happens for an empty name. Throws Error.
void enter_namespace(const std::string& name);

}  // namespace theatron::bench
