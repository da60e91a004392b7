// SPDX-License-Identifier: Apache-2.0
// The heads of people who show their own face, from the bytes that came. A damaged face is
// counted, and its person keeps the usual figure.
#pragma once

#include <map>
#include <memory>

#include "client/face_keeper.h"
#include "room/own_head.h"

namespace theatron::viewer {

// Use from one thread.
class OwnHeads {
public:
    // Further ones are not drawn: each takes some 5 MB, and 1 MB of the GPU's memory.
    static constexpr std::size_t max_own_heads = 16;

    // True if somebody has another head than before. A new one takes some 10 ms.
    bool take(const client::FaceKeeper::Faces& faces);

    // Null: this person has none.
    std::shared_ptr<const room::OwnHead> of(ParticipantId person) const;
    // Faces that could not be read, so far.
    std::size_t damaged() const { return damaged_; }

private:
    struct Head {
        std::shared_ptr<const Bytes> bytes;
        std::shared_ptr<const room::OwnHead> head;  // null: damaged
    };
    std::map<ParticipantId, Head> heads_;
    std::size_t damaged_ = 0;
};

// Null for what is no face in a session. Safe on any bytes.
std::shared_ptr<const room::OwnHead> own_head_of(ByteView bytes);

}  // namespace theatron::viewer
