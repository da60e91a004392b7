// SPDX-License-Identifier: Apache-2.0
// The part of a case folder that a session shares: its description and the bytes of its surfaces
// and images, each by its hash. The file of identifiers is never read.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "base/content_hash.h"
#include "medical/shared_case.h"
#include "medical/volume.h"

namespace theatron::cases {

struct ShareableCase {
    ContentHash id;  // of the encoded description
    medical::SharedCase description;
    // The window and the place of the middle axial slice of the first series, if there is one.
    std::optional<medical::Window> window;
    double middle_slice_mm = 0;
    // The encoded description, too.
    std::map<ContentHash, std::shared_ptr<const Bytes>> content;
    std::uint64_t bytes = 0;  // of all content
};

using HashOf = std::function<ContentHash(ByteView)>;

// Reads and checks the whole case, which is taken into memory if it has at most `max_bytes`.
// Throws Error with one sentence at the first problem.
ShareableCase share_case(const std::filesystem::path& folder, const HashOf& hash_of,
                         std::uint64_t max_bytes);

}  // namespace theatron::cases
