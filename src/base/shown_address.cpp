// SPDX-License-Identifier: Apache-2.0
#include "base/shown_address.h"

#include <algorithm>

namespace theatron {

std::string shown_address(std::string_view text) {
    constexpr std::string_view mark = "://";
    const auto scheme = text.find(mark);
    if (scheme == text.npos)
        return std::string(text);
    const auto begin = scheme + mark.size();
    const auto path = std::min(text.find_first_of("/?#", begin), text.size());
    std::string shown(text.substr(0, begin));
    const auto at = text.rfind('@');
    const bool has_user = at != text.npos && at >= begin;
    // A password with a slash in it.
    if (has_user && at > path)
        return shown + "...";
    const auto host = has_user ? at + 1 : begin;
    auto end = text.find_first_of("?#=&;", path);
    if (end == text.npos)
        return shown.append(text.substr(host));
    if (text[end] != '?' && text[end] != '#')
        end = std::max(text.rfind('/', end) + 1, path);
    return shown.append(text.substr(host, end - host)) + "...";
}

}  // namespace theatron
