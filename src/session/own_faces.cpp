// SPDX-License-Identifier: Apache-2.0
#include "session/own_faces.h"

#include <utility>

namespace theatron::session {
namespace {

using wire::OwnFace;
using FaceKind = OwnFace::Kind;

}  // namespace

bool OwnFaces::may_have(ParticipantId id) const {
    const Admission::Participant* person = admission_.find(id);
    return person && person->takes_part() && !person->records && person->may(Right::see) &&
           !person->has(wire::Feature::sends_only);
}

std::shared_ptr<const Bytes> OwnFaces::content(const ContentHash& hash) const {
    for (const auto& [owner, face] : faces_)
        if (face.whole && face.hash == hash)
            return face.whole;
    return nullptr;
}

void OwnFaces::tell(ParticipantId receiver, ParticipantId owner, const OwnFace& face) {
    actions_.push_back(action::SendState{
        receiver, {wire::StateTopic::own_face, std::uint32_t(owner)}, wire::encode_own_face(face)});
}

void OwnFaces::tell_others(ParticipantId owner, const OwnFace& face) {
    for (const auto& [id, person] : admission_.participants())
        if (id != owner && may_have(id))
            tell(id, owner, face);
}

void OwnFaces::tell_all(ParticipantId id) {
    if (!may_have(id))
        return;
    for (const auto& [owner, face] : faces_)
        if (owner != id && face.whole)
            tell(id, owner, {FaceKind::offered, face.size, face.hash});
}

void OwnFaces::answer(ParticipantId owner, const Face& face) {
    tell(owner, owner, {FaceKind::received, std::uint32_t(face.received()), face.hash});
}

void OwnFaces::forget(ParticipantId owner) {
    const auto found = faces_.find(owner);
    if (found != faces_.end()) {
        const bool was_told = found->second.whole != nullptr;
        faces_.erase(found);
        if (was_told)
            tell_others(owner, {});
    }
    const Admission::Participant* person = admission_.find(owner);
    if (!person || !person->takes_part())
        budgets_.erase(owner);
}

void OwnFaces::follow_rights(ParticipantId id) {
    const Admission::Participant* person = admission_.find(id);
    if (person && !person->may(Right::be_seen))
        forget(id);
}

bool OwnFaces::put(ParticipantId sender, const wire::State& state, TimePoint now) {
    if (!budgets_[sender].states.take(now))
        return false;
    if (state.key.topic == wire::StateTopic::face_piece) {
        if (const auto found = faces_.find(sender); found != faces_.end())
            on_piece(sender, found->second, state);
        return true;
    }
    const auto face = wire::decode_own_face(state.body);
    if (state.key.id != std::uint32_t(sender) || !face)
        return true;
    if (face->kind == FaceKind::offered)
        on_offer(sender, *face, now);
    else if (face->kind == FaceKind::none)
        forget(sender);
    return true;
}

void OwnFaces::on_offer(ParticipantId owner, const OwnFace& offer, TimePoint now) {
    const auto known = faces_.find(owner);
    if (known != faces_.end() && known->second.hash == offer.hash &&
        known->second.size == offer.bytes)
        return answer(owner, known->second);
    forget(owner);
    const Admission::Participant& person = *admission_.find(owner);
    if (!person.may(Right::be_seen) || person.records || !make_digest_ ||
        faces_.size() >= max_own_faces || !budgets_[owner].faces.take(now))
        return tell(owner, owner, {});
    Face face;
    face.size = offer.bytes;
    face.hash = offer.hash;
    face.digest = make_digest_();
    answer(owner, faces_.emplace(owner, std::move(face)).first->second);
}

void OwnFaces::on_piece(ParticipantId owner, Face& face, const wire::State& piece) {
    // A piece that comes twice, or behind one that was lost: its owner asks what is here.
    if (face.whole || piece.key.id != face.coming.size())
        return;
    if (piece.body.size() > face.size - face.coming.size()) {
        forget(owner);
        return tell(owner, owner, {});
    }
    // Memory grows with what has come, not with what was announced.
    face.coming.insert(face.coming.end(), piece.body.begin(), piece.body.end());
    face.digest->add(piece.body);
    if (face.coming.size() == face.size) {
        if (face.digest->finish() != face.hash) {
            forget(owner);
            return tell(owner, owner, {});
        }
        face.digest.reset();
        face.whole = std::make_shared<const Bytes>(std::move(face.coming));
        tell_others(owner, {FaceKind::offered, face.size, face.hash});
    } else if (face.coming.size() % (wire::own_face_piece * wire::own_face_group) != 0) {
        return;
    }
    answer(owner, face);
}

}  // namespace theatron::session
