// SPDX-License-Identifier: Apache-2.0
// The links of a host, in its state folder (docs/keys.md): one of each role that stays valid, and
// any number that were made for somebody and expire. A running host follows the files.
//
// All functions throw Error, one sentence that names the file and says what to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/utc_text.h"
#include "net/link.h"
#include "wire/role.h"

namespace theatron::host {

// Links at once; one more is not made.
inline constexpr std::size_t max_made_links = 256;
inline constexpr std::size_t max_label = 64;  // characters

struct KnownLink {
    std::string name;  // not secret: 8 hex digits, or the role of a link that stays valid
    wire::Role role{};
    std::string token;
    std::optional<files::UtcSeconds> expires;
    std::string label;  // for whom it is
    bool has_expired(files::UtcSeconds now) const { return expires && now >= *expires; }
};

struct KnownLinks {
    std::vector<KnownLink> links;
    // A sentence for each file that cannot be used. Its link admits nobody.
    std::vector<std::string> problems;
};

// Makes the link of each role that has none yet.
void make_role_links(const std::filesystem::path& folder);

// All links, each judged by its own file alone. That of a role is made where there is none yet.
// Never throws Error.
KnownLinks load_links(const std::filesystem::path& folder);

// True if there is a link of each role, so that load_links() only reads.
bool has_links(const std::filesystem::path& folder);

// The link as people get it. `address`: of the host, without a token.
std::string link_text(const KnownLink& link, net::Link address);

// Makes a link. Deletes expired ones first where there are too many.
KnownLink make_link(const std::filesystem::path& folder, wire::Role role,
                    std::optional<files::UtcSeconds> expires, const std::string& label);

// Makes a link invalid for good, on the disk; the one of a role gets another token. False if there
// is none of this name. Throws Error where the file stays as it was.
bool revoke_link(const std::filesystem::path& folder, const std::string& name);

// The files of all links, as another state of them differs: by a file that is new or gone, by what
// is in it, or by who may read it.
struct LinkFile {
    std::string name;
    std::uint64_t inode = 0;
    std::int64_t changed_ns = 0;
    bool operator==(const LinkFile&) const = default;
};
using LinkFiles = std::vector<LinkFile>;
LinkFiles look_at_links(const std::filesystem::path& folder);

// A running host writes which files its links are from, once it admits by them alone.
void tell_links_followed(const std::filesystem::path& folder, const LinkFiles& files);
// True if it admits by the files as they are now.
bool are_links_followed(const std::filesystem::path& folder);

}  // namespace theatron::host
