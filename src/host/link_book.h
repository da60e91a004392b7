// SPDX-License-Identifier: Apache-2.0
// The links of a host, in its state folder (docs/keys.md): one of each role that stays valid, and
// any number that were made for somebody and expire. A running host follows the files.
//
// All functions throw Error, one sentence that names the file and says what to do.
#pragma once

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
    // A sentence for each file of a made link that cannot be used. Its link admits nobody.
    std::vector<std::string> problems;
};

// All links. The one of each role is made where there is none yet.
KnownLinks load_links(const std::filesystem::path& folder);

// True if there is a link of each role, so that load_links() only reads.
bool has_links(const std::filesystem::path& folder);

// The link as people get it. `address`: of the host, without a token.
std::string link_text(const KnownLink& link, net::Link address);

// Makes a link. Deletes expired ones first where there are too many.
KnownLink make_link(const std::filesystem::path& folder, wire::Role role,
                    std::optional<files::UtcSeconds> expires, const std::string& label);

// Makes a link invalid for good; the one of a role gets another token. False if there is none of
// this name.
bool revoke_link(const std::filesystem::path& folder, const std::string& name);

// Notices changes of the files, also by other programs.
class LinkWatch {
public:
    explicit LinkWatch(std::filesystem::path folder);
    // True if a file has changed since the last call.
    bool changed();

private:
    std::vector<std::filesystem::file_time_type> times() const;
    const std::filesystem::path folder_;
    std::vector<std::filesystem::file_time_type> seen_;
};

}  // namespace theatron::host
