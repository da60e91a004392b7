// SPDX-License-Identifier: Apache-2.0
// Parts that the sources that encrypt with OpenSSL share.
#pragma once

#include <openssl/evp.h>

#include <cstddef>
#include <memory>

namespace theatron::net {

struct FreeCipher {
    void operator()(EVP_CIPHER_CTX* context) const { EVP_CIPHER_CTX_free(context); }
};
using Cipher = std::unique_ptr<EVP_CIPHER_CTX, FreeCipher>;

inline unsigned char* raw(std::byte* bytes) {
    return reinterpret_cast<unsigned char*>(bytes);
}
inline const unsigned char* raw(const std::byte* bytes) {
    return reinterpret_cast<const unsigned char*>(bytes);
}

}  // namespace theatron::net
