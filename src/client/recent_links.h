// SPDX-License-Identifier: Apache-2.0
// The sessions that a person has entered in a window, so that the form can offer them again:
// `recent_links` in the person's state folder. A link is a secret: only the person may read the
// file, and nothing else is to show a link of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/utc_text.h"

namespace theatron::client {

struct RecentLink {
    std::string link;     // as text
    std::string session;  // its name
    bool operator==(const RecentLink&) const = default;
};
using RecentLinks = std::vector<RecentLink>;  // the newest first

// A link that is entered when the list is full replaces the oldest.
inline constexpr std::size_t max_recent_links = 5;

// The same with this one first. Another one with its host and token is replaced.
RecentLinks with_newest(RecentLinks links, const RecentLink& newest);
// The text behind the name of a session in a list, without the token: "expert at or-3:4400".
std::string recent_link_text(const RecentLink& link);

// One line for each: the link, a space, and the session's name.
std::string recent_links_text(const RecentLinks& links);
// Lines that are no link, and links that have expired by `now`, are left out. Safe for any text.
RecentLinks parse_recent_links(const std::string& text, files::UtcSeconds now);

// None if the folder's name is empty, or it has none. `problem` becomes one sentence if the file
// cannot be used, else empty.
RecentLinks load_recent_links(const std::filesystem::path& folder, std::string& problem);
// Atomic. Returns one sentence about the problem; empty if there is none.
std::string save_recent_links(const std::filesystem::path& folder, const RecentLinks& links);

}  // namespace theatron::client
