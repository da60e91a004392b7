// SPDX-License-Identifier: Apache-2.0
// Links and tokens on the command line, which every user of the machine can read there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "net/link.h"

namespace theatron::app {

// Parses a link, or @FILE, a file that begins with a link; @/dev/stdin reads standard input.
net::Link parse_link_argument(const std::string& argument);  // throws Error

// True for @FILE; not for standard input, which can be read only once.
bool is_link_file(const std::string& argument);

// Characters that are read from a file at most; no link is longer.
inline constexpr std::size_t max_link_characters = 4096;

// Returns the program's arguments. In `argv` itself, which `ps` shows, asterisks replace the tokens
// of links and the value of --token.
std::vector<std::string> take_arguments(int argc, char** argv);

}  // namespace theatron::app
