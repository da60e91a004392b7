// SPDX-License-Identifier: Apache-2.0
#include "client/face_keeper.h"

#include <utility>

#include "net/content_digest.h"

namespace theatron::client {

using FaceKind = wire::OwnFace::Kind;

FaceKeeper::FaceKeeper() : fetch_(net::make_content_digest) {}

void FaceKeeper::on_connected() {
    const std::lock_guard lock(mutex_);
    told_.clear();
    faces_.clear();
    fetch_.on_connected();
    want();
}

void FaceKeeper::on_face(ParticipantId owner, const wire::OwnFace& face) {
    const std::lock_guard lock(mutex_);
    const auto known = told_.find(owner);
    if (face.kind == FaceKind::offered && known != told_.end() && known->second == face) {
        // It may have been away in between, when it was asked for.
        fetch_.retry();
        return;
    }
    if (known != told_.end())
        told_.erase(known);
    faces_.erase(owner);
    if (face.kind == FaceKind::offered && told_.size() < max_kept_faces)
        told_.emplace(owner, face);
    want();
}

void FaceKeeper::want() {
    std::vector<session::ContentFetch::Wanted> wanted;
    for (const auto& [owner, face] : told_)
        if (!faces_.contains(owner))
            wanted.push_back({face.hash, face.bytes, true});
    fetch_.want(std::move(wanted));
}

bool FaceKeeper::on_content(const wire::Content& piece, TimePoint now) {
    const std::lock_guard lock(mutex_);
    auto complete = fetch_.on_content(piece, now);
    if (!complete)
        return false;
    const auto bytes = std::make_shared<const Bytes>(std::move(complete->bytes));
    for (const auto& [owner, face] : told_)
        if (face.hash == complete->hash)
            faces_[owner] = bytes;
    want();
    return true;
}

std::vector<wire::RequestContent> FaceKeeper::take_requests(TimePoint now) {
    const std::lock_guard lock(mutex_);
    return fetch_.take_requests(now);
}

FaceKeeper::Faces FaceKeeper::faces() const {
    const std::lock_guard lock(mutex_);
    return faces_;
}

}  // namespace theatron::client
