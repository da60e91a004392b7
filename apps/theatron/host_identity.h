// SPDX-License-Identifier: Apache-2.0
// What a host keeps between runs, and where others reach it.
#pragma once

#include <filesystem>
#include <string>

namespace theatron::app {

// Where a host keeps its keys and tokens unless told otherwise.
std::filesystem::path default_state_folder();

// The token in this file of the folder, made at first use: it outlives the host, so that
// participants find back after a restart. Only its owner may read it. Throws Error.
std::string load_or_make_token(const std::filesystem::path& folder, const char* name);

// Where others reach a host that listens everywhere: its first outside IPv4 address, or
// 127.0.0.1.
std::string outside_address();

}  // namespace theatron::app
