// SPDX-License-Identifier: Apache-2.0
#include "link_argument.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <string_view>

#include "base/error.h"

namespace theatron::app {
namespace {

void cover(char* begin, char* end) {
    std::fill(begin, end, '*');
}

void cover_token_of_link(char* argument) {
    constexpr std::string_view key = "join=";
    char* found = std::strstr(argument, key.data());
    if (!found)
        return;
    found += key.size();
    cover(found, found + std::strcspn(found, "&"));
}

}  // namespace

bool is_link_file(const std::string& argument) {
    return argument.starts_with('@') && argument != "@/dev/stdin";
}

net::Link parse_link_argument(const std::string& argument) {
    if (!argument.starts_with('@'))
        return net::parse_link(argument);
    const std::string path = argument.substr(1);
    std::ifstream in(path);
    std::string link;
    // Not to the end: a pipe may stay open.
    if (!(in >> std::setw(int(max_link_characters)) >> link))
        throw Error("'" + path + "' holds no link, or cannot be read.");
    return net::parse_link(link);
}

std::vector<std::string> take_arguments(int argc, char** argv) {
    const std::vector<std::string> arguments(argv, argv + argc);
    constexpr std::string_view flag = "--token";
    for (int i = 1; i < argc; ++i) {
        const std::string& argument = arguments[std::size_t(i)];
        char* const end = argv[i] + argument.size();
        if (argument.starts_with(std::string(flag) + "="))
            cover(argv[i] + flag.size() + 1, end);
        else if (arguments[std::size_t(i) - 1] == flag)
            cover(argv[i], end);
        else
            cover_token_of_link(argv[i]);
    }
    return arguments;
}

}  // namespace theatron::app
