// SPDX-License-Identifier: Apache-2.0
// What a host keeps between runs, and where others reach it.
#pragma once

#include <filesystem>
#include <string>

namespace theatron::host {

// Where a host keeps its keys and tokens unless told otherwise. Throws Error where the environment
// names no folder.
std::filesystem::path default_state_folder();

// A shorter token can be guessed: some hundred a second can be tried.
inline constexpr std::size_t least_token_characters = 16;

// Throws Error for a token that can be guessed or cannot be part of a link.
void check_token(const std::string& token);

// The first word of a file or pipe that nobody else may read. Throws Error.
std::string read_token(const std::filesystem::path& path);

// The token in this file of the folder, made at first use: it outlives the host, so that
// participants find back after a restart. Only its owner may read it. Throws Error.
std::string load_or_make_token(const std::filesystem::path& folder, const char* name);

// Where others reach a host that listens everywhere: its first outside IPv4 address, or
// 127.0.0.1.
std::string outside_address();

}  // namespace theatron::host
