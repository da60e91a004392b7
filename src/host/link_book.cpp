// SPDX-License-Identifier: Apache-2.0
#include "host/link_book.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "base/outside_text.h"
#include "files/private_file.h"
#include "host/host_identity.h"
#include "net/certificate.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t name_digits = 8;
constexpr const char* never = "-";

// The file of a role's token. That of the expert has this name since there was only one link.
const char* token_file(wire::Role role) {
    switch (role) {
        case wire::Role::expert:
            return "join.token";
        case wire::Role::publisher:
            return "publish.token";
        case wire::Role::observer:
            return "observer.token";
        case wire::Role::operator_:
            return "operator.token";
    }
    return "join.token";
}

fs::path made_links(const fs::path& folder) {
    return folder / "links";
}

bool is_name(const std::string& text) {
    return text.size() == name_digits && std::ranges::all_of(text, [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

// "ROLE EXPIRES TOKEN LABEL", EXPIRES "-" or a time.
KnownLink read_link(const fs::path& path, const std::string& text) {
    std::istringstream words(text);
    std::string role, expires;
    KnownLink link;
    link.name = path.filename().string();
    words >> role >> expires >> link.token;
    std::getline(words >> std::ws, link.label);
    link.label = clean_text(link.label, max_label);
    const auto known = wire::parse_role(role);
    const auto time = files::parse_utc(expires);
    if (!known || (!time && expires != never))
        throw Error("'" + path.string() + "' is no link; delete it.");
    try {
        check_token(link.token);
    } catch (const Error& error) {
        throw Error("In '" + path.string() + "': " + error.what());
    }
    link.role = *known;
    link.expires = time;
    return link;
}

KnownLinks load_made_links(const fs::path& folder) {
    KnownLinks book;
    std::vector<KnownLink>& links = book.links;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(made_links(folder), none)) {
        if (!is_name(entry.path().filename().string()))
            continue;
        try {
            // Another program may delete it meanwhile.
            if (const auto text = files::read_private_file(entry.path(), files::Privacy::secret))
                links.push_back(read_link(entry.path(), *text));
        } catch (const Error& error) {
            book.problems.emplace_back(error.what());
        }
        if (links.size() + book.problems.size() > max_made_links)
            throw Error("'" + made_links(folder).string() + "' has more than " +
                        std::to_string(max_made_links) +
                        " links; delete some with 'theatron link --revoke'.");
    }
    std::ranges::sort(links, {}, &KnownLink::name);
    std::ranges::sort(book.problems);
    return book;
}

}  // namespace

KnownLinks load_links(const fs::path& folder) {
    std::vector<KnownLink> links;
    for (const wire::Role role : wire::roles)
        links.push_back({wire::text_of(role), role, load_or_make_token(folder, token_file(role)),
                         std::nullopt, ""});
    KnownLinks made = load_made_links(folder);
    links.insert(links.end(), std::make_move_iterator(made.links.begin()),
                 std::make_move_iterator(made.links.end()));
    return {std::move(links), std::move(made.problems)};
}

std::string link_text(const KnownLink& link, net::Link address) {
    address.token = link.token;
    address.role = wire::text_of(link.role);
    address.until = link.expires ? files::utc_text(*link.expires) : "";
    return net::format_link(address);
}

bool has_links(const fs::path& folder) {
    return std::all_of(std::begin(wire::roles), std::end(wire::roles),
                       [&](wire::Role role) { return fs::exists(folder / token_file(role)); });
}

KnownLink make_link(const fs::path& folder, wire::Role role,
                    std::optional<files::UtcSeconds> expires, const std::string& label) {
    files::open_private_folder(made_links(folder));
    std::vector<KnownLink> present = load_made_links(folder).links;
    const files::UtcSeconds now = files::utc_now();
    if (present.size() >= max_made_links) {
        for (const KnownLink& link : present)
            if (link.has_expired(now))
                (void)revoke_link(folder, link.name);
        present = load_made_links(folder).links;
    }
    if (present.size() >= max_made_links)
        throw Error("There are " + std::to_string(max_made_links) +
                    " links already, which is the most it keeps; delete one with 'theatron link "
                    "--revoke'.");
    KnownLink link{net::random_token().substr(0, name_digits), role, net::random_token(), expires,
                   clean_text(label, max_label)};
    files::write_private_file(made_links(folder) / link.name,
                              std::string(wire::text_of(role)) + " " +
                                  (expires ? files::utc_text(*expires) : never) + " " + link.token +
                                  " " + link.label + "\n");
    return link;
}

bool revoke_link(const fs::path& folder, const std::string& name) {
    if (const auto role = wire::parse_role(name)) {
        files::write_private_file(folder / token_file(*role), net::random_token() + "\n");
        return true;
    }
    std::error_code none;
    return is_name(name) && fs::remove(made_links(folder) / name, none);
}

LinkWatch::LinkWatch(fs::path folder) : folder_(std::move(folder)), seen_(times()) {}

std::vector<fs::file_time_type> LinkWatch::times() const {
    std::vector<fs::file_time_type> times;
    std::error_code none;
    for (const wire::Role role : wire::roles)
        times.push_back(fs::last_write_time(folder_ / token_file(role), none));
    times.push_back(fs::last_write_time(made_links(folder_), none));
    return times;
}

bool LinkWatch::changed() {
    auto now = times();
    if (now == seen_)
        return false;
    seen_ = std::move(now);
    return true;
}

}  // namespace theatron::host
