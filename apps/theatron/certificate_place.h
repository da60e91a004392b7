// SPDX-License-Identifier: Apache-2.0
// Where a host looks for the certificate of its organisation: as its configuration says, or, until
// that says nothing, beside the configuration.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/private_file.h"

namespace theatron::app {

struct CertificatePlace {
    std::filesystem::path config;            // empty: there is none
    std::filesystem::path certificate, key;  // absolute where a configuration names them
    std::string name;                        // `public-name` without its port; empty: none
    std::string state;                       // `state`; empty: none is named
    bool is_named = false;                   // the configuration names both files
    bool is_behind_proxy = false;            // links have the proxy's certificate
    std::vector<std::string> missing_lines;  // that the configuration needs for them
};

// Pure. `file`: an absolute path of the configuration with this text. Mistakes of other lines are
// for `theatron host --check-config`.
CertificatePlace certificate_place(const std::filesystem::path& file, std::string_view text);

// That of the configuration in `file`; empty: of the only one in /etc/theatron. Throws Error.
CertificatePlace find_certificate_place(const std::string& file);

// The user that owns the host's files, if this is another one: `user`; empty: for root and files in
// /etc/theatron the user theatron, where there is one. Throws Error.
std::optional<files::Owner> certificate_owner(const std::string& user,
                                              const std::filesystem::path& key);

}  // namespace theatron::app
