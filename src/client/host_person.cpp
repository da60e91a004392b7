// SPDX-License-Identifier: Apache-2.0
#include "client/host_person.h"

#include "base/small_letters.h"
#include "net/content_digest.h"
#include "wire/protocol.h"

namespace theatron::client {
namespace {

Bytes digest(ByteView first, ByteView second) {
    const auto sha256 = net::make_content_digest();
    sha256->add(first);
    sha256->add(second);
    const ContentHash hash = sha256->finish();
    return {hash.bytes.begin(), hash.bytes.end()};
}

// HMAC-SHA-256 (RFC 2104), with a key of at most a block.
Bytes keyed_digest(ByteView key, ByteView text) {
    constexpr std::size_t block = 64;
    Bytes inner(block, std::byte(0x36)), outer(block, std::byte(0x5c));
    for (std::size_t i = 0; i < key.size() && i < block; ++i) {
        inner[i] ^= key[i];
        outer[i] ^= key[i];
    }
    return digest(outer, digest(inner, text));
}

}  // namespace

std::string host_identity(const net::Link& link) {
    const std::string name = in_small_letters(link.host);
    // Addresses, and names that each network gives by itself, lead to many hosts.
    const auto dot = name.rfind('.');
    const bool is_of_internet = dot != name.npos && dot + 1 < name.size() &&
                                name.find(':') == name.npos &&
                                !(name[dot + 1] >= '0' && name[dot + 1] <= '9') &&
                                !name.ends_with(".local") && !name.ends_with(".localhost");
    return is_of_internet ? "name:" + name : "certificate:" + link.fingerprint;
}

Bytes person_for_host(ByteView secret, const net::Link& link) {
    if (secret.empty())
        return {};
    const std::string text = "theatron-person/" + host_identity(link);
    Bytes id = keyed_digest(secret,
                            ByteView(reinterpret_cast<const std::byte*>(text.data()), text.size()));
    id.resize(wire::person_id_size);
    return id;
}

}  // namespace theatron::client
