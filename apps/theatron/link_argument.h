// SPDX-License-Identifier: Apache-2.0
// Links and tokens on the command line, which every user of the machine can read there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "net/link.h"

namespace theatron::app {

// A link, or @FILE with a link as its first word; @/dev/stdin reads standard input. Throws Error.
net::Link parse_link_argument(const std::string& argument);

// A file that holds more is refused: it holds no link.
inline constexpr std::size_t max_link_characters = 4096;

// The program's arguments; in `argv` itself, where `ps` looks, asterisks take the place of links'
// tokens and of what --token is given.
std::vector<std::string> take_arguments(int argc, char** argv);

}  // namespace theatron::app
