// SPDX-License-Identifier: Apache-2.0
#include "client/recent_links.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/outside_text.h"
#include "base/shown_name.h"
#include "files/private_file.h"
#include "net/link.h"
#include "phrases/phrase.h"
#include "wire/control.h"
#include "wire/role.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

constexpr const char* links_file = "recent_links";
constexpr std::size_t max_shown_text = 60;

std::optional<net::Link> parsed(const std::string& text) {
    try {
        return net::parse_link(text);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// A line of the file holds it.
bool is_one_word(const std::string& link) {
    return clean_text(link, link.size()) == link && link.find(' ') == std::string::npos;
}

// Two texts of one link may differ in its role and time.
bool is_same(const std::string& a, const std::string& b) {
    const auto one = parsed(a), other = parsed(b);
    return one && other && one->host == other->host && one->port == other->port &&
           one->token == other->token;
}

bool has_expired(const net::Link& link, files::UtcSeconds now) {
    const auto until = files::parse_utc(link.until);
    return until && now >= *until;
}

}  // namespace

RecentLinks with_newest(RecentLinks links, const RecentLink& newest) {
    std::erase_if(links, [&](const RecentLink& known) { return is_same(known.link, newest.link); });
    links.insert(links.begin(), newest);
    links.resize(std::min(links.size(), max_recent_links));
    return links;
}

std::string recent_link_text(const RecentLink& recent) {
    const auto link = parsed(recent.link);
    if (!link)
        return "";
    const std::string place = net::host_and_port(*link);
    const auto role = wire::parse_role(link->role);
    return clean_text(link->role.empty() ? say(Phrase::form_recent_host, place)
                                         : say(Phrase::form_recent_place,
                                               role ? wire::spoken(*role) : link->role, place),
                      max_shown_text);
}

std::string recent_links_text(const RecentLinks& links) {
    std::string text;
    for (const RecentLink& recent : links)
        if (is_one_word(recent.link))
            text += recent.link + " " + clean_name(recent.session, wire::max_name) + "\n";
    return text;
}

RecentLinks parse_recent_links(const std::string& text, files::UtcSeconds now) {
    RecentLinks links;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && links.size() < max_recent_links;) {
        const auto space = line.find(' ');
        if (space == std::string::npos)
            continue;
        const std::string link = line.substr(0, space);
        const std::string session = clean_name(line.substr(space + 1), wire::max_name);
        if (const auto read = parsed(link); read && !has_expired(*read, now))
            links.push_back({link, session.empty() ? read->host : session});
    }
    return links;
}

RecentLinks load_recent_links(const std::filesystem::path& folder, std::string& problem) {
    problem.clear();
    if (folder.empty())
        return {};
    try {
        const auto text = files::read_private_file(folder / links_file, files::Privacy::secret);
        return parse_recent_links(text.value_or(""), files::utc_now());
    } catch (const Error& error) {
        problem = std::string("Sessions that were entered before are not offered. ") + error.what();
        return {};
    }
}

std::string save_recent_links(const std::filesystem::path& folder, const RecentLinks& links) {
    if (folder.empty())
        return "";
    try {
        files::open_private_folder(folder);
        files::write_private_file(folder / links_file, recent_links_text(links));
        return "";
    } catch (const Error& error) {
        return std::string("The session is not kept for the next time. ") + error.what();
    }
}

}  // namespace theatron::client
