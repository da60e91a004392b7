// SPDX-License-Identifier: Apache-2.0
// The own faces of other people at a participant: fetched by their hashes, in memory only, and
// forgotten when the host says so or the connection ends.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "base/ids.h"
#include "session/content_fetch.h"
#include "wire/own_face.h"

namespace theatron::client {

// All functions: from any thread.
class FaceKeeper {
public:
    // As many as a host keeps; further ones are ignored.
    static constexpr std::size_t max_kept_faces = 40;

    FaceKeeper();

    void on_connected();
    void on_face(ParticipantId owner, const wire::OwnFace& face);
    // True if another face is whole.
    bool on_content(const wire::Content& piece, TimePoint now);
    std::vector<wire::RequestContent> take_requests(TimePoint now);

    using Faces = std::map<ParticipantId, std::shared_ptr<const Bytes>>;
    // Those that are whole; nobody has looked into their bytes (face::parse_enrolled).
    Faces faces() const;

private:
    void want();  // mutex_ is held

    mutable std::mutex mutex_;  // guards all below
    session::ContentFetch fetch_;
    std::map<ParticipantId, wire::OwnFace> told_;
    Faces faces_;
};

}  // namespace theatron::client
