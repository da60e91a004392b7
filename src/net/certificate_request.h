// SPDX-License-Identifier: Apache-2.0
// A host's key, and the request with which an organisation's certification authority (CA) makes a
// certificate for it.
//
// Pure: no files, no clock.
#pragma once

#include <string>
#include <vector>

namespace theatron::net {

inline constexpr std::size_t max_request_names = 20;

// A new P-256 key in PEM, without a passphrase. Throws Error.
std::string make_key();

// PKCS #10 in PEM for these DNS names and IP addresses, signed with the key; the first one is also
// the common name. Throws Error for a key that is damaged, and for a name that is none.
std::string certificate_request(const std::string& key_pem, const std::vector<std::string>& names);

}  // namespace theatron::net
