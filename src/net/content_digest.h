// SPDX-License-Identifier: Apache-2.0
// SHA-256 for content that travels by its hash.
#pragma once

#include <memory>

#include "base/content_hash.h"

namespace theatron::net {

// Throws Error if the library has no SHA-256.
std::unique_ptr<ContentDigest> make_content_digest();
ContentHash content_hash(ByteView content);

}  // namespace theatron::net
