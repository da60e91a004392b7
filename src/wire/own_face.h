// SPDX-License-Identifier: Apache-2.0
// A person's own face on its way to the host: the states of topics `own_face` and `face_piece`
// (docs/formats/own_face.md). From the host to the others a face goes as content, by its hash.
#pragma once

#include "base/bytes.h"
#include "base/content_hash.h"
#include "base/status.h"
#include "wire/envelope.h"

namespace theatron::wire {

inline constexpr std::size_t max_own_face_bytes = 600 * 1024;
// Pieces of this size are sent in groups of this number: as many as one envelope of states holds.
// After each group the host says how much it has; nothing more is sent before that.
inline constexpr std::size_t own_face_piece = max_state_size, own_face_group = 7;

struct OwnFace {
    enum class Kind : std::uint8_t {
        none,      // to the host and to the others: there is no face any more; to its owner: the
                   // host does not take it
        offered,   // by the owner; to the others: the host has all of it
        received,  // to the owner
    };
    Kind kind = Kind::none;
    // The size of the whole face, 1 to max_own_face_bytes; `received`: those that the host has,
    // from the first on.
    std::uint32_t bytes = 0;
    ContentHash hash;
    bool operator==(const OwnFace&) const = default;
};

Bytes encode_own_face(const OwnFace& face);

// Safe for untrusted input.
Result<OwnFace> decode_own_face(ByteView bytes);

}  // namespace theatron::wire
