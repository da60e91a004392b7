// SPDX-License-Identifier: Apache-2.0
// The own face of a participant, and those of the others.
#include <utility>

#include "base/steady_clock.h"
#include "client/participant_shared.h"
#include "net/content_digest.h"

namespace theatron::client {

void Participant::show_own_face(std::shared_ptr<const Bytes> face) {
    const std::lock_guard lock(shared_->mutex);
    shared_->own_face = std::move(face);
}

session::FaceUpload::State Participant::own_face_state() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->own_face_state;
}

FaceKeeper::Faces Participant::own_faces() const {
    return faces_ ? faces_->faces() : FaceKeeper::Faces();
}

// Ten times a second while joined.
void Participant::send_own_face() {
    std::shared_ptr<const Bytes> face;
    {
        const std::lock_guard lock(shared_->mutex);
        face = shared_->own_face;
    }
    if (face != upload_.shown())
        upload_.show(face, face ? net::content_hash(*face) : ContentHash{});
    const auto pieces = upload_.take(steady_now());
    std::vector<wire::State> states;
    for (const session::FaceUpload::Piece& piece : pieces) {
        const bool is_offer = piece.topic == wire::StateTopic::own_face;
        const std::uint32_t id =
            is_offer ? std::uint32_t(session_.welcome().participant) : piece.place;
        states.push_back({{piece.topic, id}, piece.body});
    }
    if (!states.empty())
        shared_->client->send_states(states);
    const std::lock_guard lock(shared_->mutex);
    shared_->own_face_state = upload_.state();
}

void Participant::on_own_face(ParticipantId person, ByteView body) {
    if (!session_.joined())
        return;
    if (person == session_.welcome().participant)
        return upload_.on_answer(body, steady_now());
    const auto face = wire::decode_own_face(body);
    if (!faces_ || !face)
        return;
    faces_->on_face(person, *face);
    tell_content();
    announce();
}

}  // namespace theatron::client
