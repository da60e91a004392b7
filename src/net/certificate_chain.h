// SPDX-License-Identifier: Apache-2.0
// The files that a certification authority (CA) hands out, made into the chain that a host shows:
// the certificate of its key first, and behind each certificate that of its issuer.
//
// Pure but for is_known_here(): no clock, no files. Safe for any bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/utc_text.h"

namespace theatron::net {

// A text with more certificates is refused.
inline constexpr std::size_t max_certificates = 20;

// The certificates in a file of a CA, each in PEM: PEM or DER, or PKCS #7 in either. Throws Error
// if it holds none, or if one of them is damaged.
std::vector<std::string> certificates_in(const std::string& bytes);

struct CertificateChain {
    std::string pem;                    // without the root, which browsers have
    std::vector<std::string> left_out;  // subjects of certificates that are no part of it
    std::string issuer;                 // of the last one in `pem`
    bool has_root = false;              // the root was among the certificates
};
// The chain of the certificate that belongs to the key, from certificates in any order. If two do,
// the one that ends last is taken. nullopt: none does. Throws Error for a damaged key.
std::optional<CertificateChain> chain_of_key(const std::vector<std::string>& certificates,
                                             const std::string& key_pem);

// The DNS names and IP addresses that the first certificate in the text is for.
std::vector<std::string> names_of_certificate(const std::string& pem);

// Why browsers would refuse the first certificate of a chain: its dates, a name that it is not for
// (empty: any), or another purpose than a server's. Empty: they would not.
std::string certificate_mistake(const std::string& pem, files::UtcSeconds now,
                                const std::string& name);

// True if this machine's own list of roots leads to the chain.
bool is_known_here(const std::string& pem);

}  // namespace theatron::net
