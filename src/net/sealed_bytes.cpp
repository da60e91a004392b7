// SPDX-License-Identifier: Apache-2.0
#include "net/sealed_bytes.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <algorithm>

#include "base/error.h"
#include "net/cipher.h"

namespace theatron::net {
namespace {

constexpr std::uint8_t sealed_version = 1;
constexpr std::uint64_t block_size = 8, lanes = 1;

// Forgotten when it is destroyed.
struct SealKey {
    std::array<unsigned char, 32> bytes{};
    ~SealKey() { OPENSSL_cleanse(bytes.data(), bytes.size()); }
};

void check(bool done) {
    if (!done)
        throw Error("OpenSSL cannot seal or open a file with a passphrase here; is there memory?");
}

void derive(const Sealed& sealed, std::string_view passphrase, SealKey& key) {
    const std::uint64_t n = std::uint64_t(1) << sealed.cost;
    const std::uint64_t memory = 128 * block_size * (n + lanes) + (1 << 20);
    check(EVP_PBE_scrypt(passphrase.data(), passphrase.size(), raw(sealed.salt.data()),
                         sealed.salt.size(), n, block_size, lanes, memory, key.bytes.data(),
                         key.bytes.size()) == 1);
}

// All before the tag is sealed, too: nobody can change it unseen.
Bytes head_of(const Sealed& sealed) {
    const ByteView magic = as_bytes(sealed_magic);
    Bytes head(magic.begin(), magic.end());
    ByteWriter out(head);
    out.put(sealed_version);
    out.put(std::uint8_t(sealed.cost));
    out.put_bytes(sealed.salt);
    out.put_bytes(sealed.nonce);
    return head;
}

}  // namespace

Sealed seal(ByteView content, std::string_view passphrase, int cost) {
    Sealed sealed;
    sealed.cost = std::clamp(cost, least_seal_cost, most_seal_cost);
    check(RAND_bytes(raw(sealed.salt.data()), int(sealed.salt.size())) == 1);
    check(RAND_bytes(raw(sealed.nonce.data()), int(sealed.nonce.size())) == 1);
    SealKey key;
    derive(sealed, passphrase, key);
    const Cipher cipher(EVP_CIPHER_CTX_new());
    const Bytes head = head_of(sealed);
    sealed.content.resize(content.size());
    int written = 0;
    check(cipher &&
          EVP_EncryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, key.bytes.data(),
                             raw(sealed.nonce.data())) == 1 &&
          EVP_EncryptUpdate(cipher.get(), nullptr, &written, raw(head.data()), int(head.size())) ==
              1 &&
          EVP_EncryptUpdate(cipher.get(), raw(sealed.content.data()), &written, raw(content.data()),
                            int(content.size())) == 1 &&
          EVP_EncryptFinal_ex(cipher.get(), raw(sealed.content.data()) + written, &written) == 1 &&
          EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_GET_TAG, int(sealed.tag.size()),
                              sealed.tag.data()) == 1);
    return sealed;
}

std::optional<Bytes> unseal(const Sealed& sealed, std::string_view passphrase) {
    SealKey key;
    derive(sealed, passphrase, key);
    const Cipher cipher(EVP_CIPHER_CTX_new());
    const Bytes head = head_of(sealed);
    Bytes content(sealed.content.size());
    auto tag = sealed.tag;
    int written = 0;
    check(cipher && EVP_DecryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, key.bytes.data(),
                                       raw(sealed.nonce.data())) == 1);
    const bool is_whole =
        EVP_DecryptUpdate(cipher.get(), nullptr, &written, raw(head.data()), int(head.size())) ==
            1 &&
        EVP_DecryptUpdate(cipher.get(), raw(content.data()), &written, raw(sealed.content.data()),
                          int(sealed.content.size())) == 1 &&
        EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_SET_TAG, int(tag.size()), tag.data()) == 1 &&
        EVP_DecryptFinal_ex(cipher.get(), raw(content.data()) + written, &written) == 1;
    return is_whole ? std::optional(std::move(content)) : std::nullopt;
}

Bytes sealed_bytes(const Sealed& sealed) {
    Bytes bytes = head_of(sealed);
    ByteWriter out(bytes);
    out.put_bytes(sealed.tag);
    out.put_bytes(sealed.content);
    return bytes;
}

Result<Sealed> parse_sealed(ByteView bytes) {
    ByteReader in(bytes);
    const ByteView start = in.get_bytes(sealed_magic.size()), magic = as_bytes(sealed_magic);
    if (!std::equal(start.begin(), start.end(), magic.begin(), magic.end()))
        return Status::malformed;
    const auto version = in.get<std::uint8_t>();
    Sealed sealed;
    sealed.cost = in.get<std::uint8_t>();
    const auto take = [&](auto& field) {
        const ByteView part = in.get_bytes(field.size());
        std::copy(part.begin(), part.end(), field.begin());
    };
    take(sealed.salt);
    take(sealed.nonce);
    take(sealed.tag);
    if (!in.ok())
        return Status::truncated;
    if (version > sealed_version)
        return Status::unsupported_version;
    if (version == 0 || sealed.cost < least_seal_cost)
        return Status::malformed;
    if (sealed.cost > most_seal_cost)
        return Status::too_large;
    sealed.content.assign(in.rest().begin(), in.rest().end());
    return sealed;
}

}  // namespace theatron::net
