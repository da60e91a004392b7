// SPDX-License-Identifier: Apache-2.0
#include "net/content_digest.h"
#include "net/sha256.h"

namespace theatron::net {

std::unique_ptr<ContentDigest> make_content_digest() {
    return std::make_unique<Sha256>();
}

ContentHash content_hash(ByteView content) {
    Sha256 digest;
    digest.add(content);
    return digest.finish();
}

}  // namespace theatron::net
