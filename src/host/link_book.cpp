// SPDX-License-Identifier: Apache-2.0
#include "host/link_book.h"

#include <sys/stat.h>

#include <algorithm>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "base/log.h"
#include "base/outside_text.h"
#include "files/private_file.h"
#include "host/host_identity.h"
#include "net/certificate.h"

namespace theatron::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t name_digits = 8;
constexpr const char* never = "-";
constexpr const char* followed_file = "links.followed";

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
        case wire::Role::relay:
            break;  // its links are made, and have no file of a role
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
    const auto known = wire::parse_link_role(role);
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

// Throws Error.
std::vector<std::string> names_of_made_links(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator entry(made_links(folder), error);
    if (error == std::errc::no_such_file_or_directory)
        return names;
    for (; !error && entry != fs::directory_iterator(); entry.increment(error))
        if (std::string name = entry->path().filename().string(); is_name(name))
            names.push_back(std::move(name));
    if (error)
        throw Error("The links in '" + made_links(folder).string() +
                    "' cannot be read: " + error.message() + ".");
    std::ranges::sort(names);
    return names;
}

KnownLinks load_made_links(const fs::path& folder) {
    KnownLinks book;
    std::vector<std::string> names;
    try {
        names = names_of_made_links(folder);
    } catch (const Error& error) {
        book.problems.emplace_back(error.what());
    }
    if (names.size() > max_made_links) {
        book.problems.push_back("'" + made_links(folder).string() + "' has more than " +
                                std::to_string(max_made_links) + " links, so those from '" +
                                names[max_made_links] +
                                "' on admit nobody; delete some with 'theatron link --revoke'.");
        names.resize(max_made_links);
    }
    for (const std::string& name : names) {
        const fs::path path = made_links(folder) / name;
        try {
            // Another program may delete it meanwhile.
            if (const auto text = files::read_private_file(path, files::Privacy::secret))
                book.links.push_back(read_link(path, *text));
        } catch (const Error& error) {
            book.problems.emplace_back(error.what());
        }
    }
    return book;
}

LinkFile look_at(const fs::path& path) {
    struct stat info {};
    LinkFile file{path.filename().string(), 0, 0};
    if (stat(path.c_str(), &info) == 0) {
        file.inode = info.st_ino;
        file.changed_ns = std::int64_t(info.st_ctim.tv_sec) * 1'000'000'000 + info.st_ctim.tv_nsec;
    }
    return file;
}

std::string followed_text(const LinkFiles& files) {
    std::string text;
    for (const LinkFile& file : files)
        text += file.name + " " + std::to_string(file.inode) + " " +
                std::to_string(file.changed_ns) + "\n";
    return text;
}

}  // namespace

void make_role_links(const fs::path& folder) {
    const bool has_some = std::ranges::any_of(
        wire::roles, [&](wire::Role role) { return fs::exists(folder / token_file(role)); });
    for (const wire::Role role : wire::roles) {
        const bool was_missing = !fs::exists(folder / token_file(role));
        (void)load_or_make_token(folder, token_file(role));
        if (has_some && was_missing)
            log::warning("host",
                         "token file was missing: its token is new, and earlier links of this "
                         "role let nobody in",
                         {{"file", (folder / token_file(role)).string()}});
    }
}

KnownLinks load_links(const fs::path& folder) {
    KnownLinks book;
    for (const wire::Role role : wire::roles) {
        try {
            book.links.push_back({wire::text_of(role), role,
                                  load_or_make_token(folder, token_file(role)), std::nullopt, ""});
        } catch (const Error& error) {
            book.problems.emplace_back(error.what());
        }
    }
    KnownLinks made = load_made_links(folder);
    book.links.insert(book.links.end(), std::make_move_iterator(made.links.begin()),
                      std::make_move_iterator(made.links.end()));
    book.problems.insert(book.problems.end(), std::make_move_iterator(made.problems.begin()),
                         std::make_move_iterator(made.problems.end()));
    return book;
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
    return is_name(name) && files::remove_private_file(made_links(folder) / name);
}

LinkFiles look_at_links(const fs::path& folder) {
    LinkFiles files;
    for (const wire::Role role : wire::roles)
        files.push_back(look_at(folder / token_file(role)));
    files.push_back(look_at(made_links(folder)));
    std::vector<std::string> names;
    try {
        names = names_of_made_links(folder);
    } catch (const Error&) {
        // load_links() says why.
    }
    // All those that can be valid, and one more.
    names.resize(std::min(names.size(), max_made_links + 1));
    for (const std::string& name : names)
        files.push_back(look_at(made_links(folder) / name));
    return files;
}

void tell_links_followed(const fs::path& folder, const LinkFiles& files) {
    files::write_private_file(folder / followed_file, followed_text(files));
}

bool are_links_followed(const fs::path& folder) {
    const auto told = files::read_private_file(folder / followed_file, files::Privacy::secret);
    return told == followed_text(look_at_links(folder));
}

}  // namespace theatron::host
