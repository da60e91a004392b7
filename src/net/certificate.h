// SPDX-License-Identifier: Apache-2.0
// The host's identity: a key and a self-signed certificate, made at first start
// and kept. Participants pin its fingerprint, which is part of the link.
#pragma once

#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "files/utc_text.h"

struct ssl_st;   // OpenSSL's SSL
struct x509_st;  // OpenSSL's X509

namespace theatron::net {

struct Certificate {
    std::string certificate_pem;
    std::string private_key_pem;
    std::string fingerprint;  // SHA-256 of the certificate's DER form, 64 hex digits
};

// The fingerprint of a certificate, as in a link.
std::string certificate_fingerprint(x509_st* certificate);

// The same of the certificate that the peer of a connection shows; empty: it shows none.
std::string fingerprint_of_peer(ssl_st* connection);

// The same of the first certificate in its PEM. Throws Error if that is damaged.
std::string fingerprint_of(const Certificate& certificate);

// A new P-256 key with a certificate for ten years. Throws Error.
Certificate make_certificate();

// Reads host.crt and host.key from `folder`, or makes them and the folder, readable by their owner
// alone. After a crash in between the next start completes them. Throws Error naming the file that
// is damaged, not writable, or open to others.
Certificate load_or_make_certificate(const std::filesystem::path& folder);

// Reads a certificate, perhaps followed by those of its issuers, and its key, both in PEM: those of
// an organisation, which browsers trust. Throws Error naming the file that is missing, damaged, or
// open to others. One that has expired or is not valid yet is read, too: the clock may be wrong.
// Without a key (empty): a certificate that another program shows.
Certificate read_certificate(const std::filesystem::path& certificate,
                             const std::filesystem::path& key);

struct Validity {
    files::UtcSeconds begins = 0, ends = 0;
};
// Throws Error if the certificate is damaged.
Validity validity_of(const Certificate& certificate);

// True if the certificate is one for this DNS name or IP address.
bool is_for(const Certificate& certificate, const std::string& name);

// 128 random bits as 32 hex digits.
std::string random_token();

// Secret bytes. Throws Error.
Bytes random_bytes(std::size_t count);

// Compares in a time that does not depend on the position of the first difference.
bool equal_secrets(std::string_view a, std::string_view b);

}  // namespace theatron::net
