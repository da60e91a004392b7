// SPDX-License-Identifier: Apache-2.0
#include "session/face_upload.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

using wire::OwnFace;
using FaceKind = OwnFace::Kind;

void FaceUpload::show(std::shared_ptr<const Bytes> face, const ContentHash& hash) {
    if (face == face_)
        return;
    face_ = std::move(face);
    hash_ = hash;
    state_ = face_ ? State::sending : State::none;
    offers_ = 0;
    taken_ = 0;
    may_send_ = false;
}

void FaceUpload::on_joined() {
    state_ = face_ ? State::sending : State::none;
    knows_none_ = true;
    offers_ = 0;
    taken_ = 0;
    may_send_ = false;
    sent_ = next_ = {};
}

void FaceUpload::on_answer(ByteView body, TimePoint now) {
    const auto answer = wire::decode_own_face(body);
    if (!answer || !face_ || offers_ == 0)
        return;
    if (answer->kind == FaceKind::none) {
        state_ = State::refused;
        refused_ = now;
    }
    if (answer->kind != FaceKind::received || answer->hash != hash_ ||
        answer->bytes > face_->size())
        return;
    taken_ = answer->bytes;
    may_send_ = true;
    offers_ = 1;
    next_ = std::max(sent_ + group_period, now + (time_share - 1) * (now - sent_));
    // A host that was waited for long is asked for no more patience than this.
    next_ = std::min(next_, now + offer_patience);
    state_ = taken_ == face_->size() ? State::there : State::sending;
}

std::vector<FaceUpload::Piece> FaceUpload::take(TimePoint now) {
    std::vector<Piece> pieces;
    if (!face_) {
        if (!std::exchange(knows_none_, true))
            pieces.push_back({wire::StateTopic::own_face, 0, wire::encode_own_face({})});
        return pieces;
    }
    if (state_ == State::refused && now - refused_ >= refused_for) {
        state_ = State::sending;
        offers_ = 0;
        may_send_ = false;
    }
    if (state_ != State::sending)
        return pieces;
    if (!may_send_) {
        if (offers_ > 0 && now - sent_ < offer_patience)
            return pieces;
        if (offers_ == most_offers) {
            state_ = State::unanswered;
            return pieces;
        }
        ++offers_;
        knows_none_ = false;
        sent_ = now;
        pieces.push_back(
            {wire::StateTopic::own_face, 0,
             wire::encode_own_face({FaceKind::offered, std::uint32_t(face_->size()), hash_})});
        return pieces;
    }
    if (now < next_)
        return pieces;
    std::size_t at = taken_;
    for (std::size_t i = 0; i < wire::own_face_group && at < face_->size(); ++i) {
        const std::size_t size = std::min(wire::own_face_piece, face_->size() - at);
        const ByteView piece = ByteView(*face_).subspan(at, size);
        pieces.push_back(
            {wire::StateTopic::face_piece, std::uint32_t(at), Bytes(piece.begin(), piece.end())});
        at += size;
    }
    sent_ = now;
    may_send_ = false;  // until the host has answered
    return pieces;
}

}  // namespace theatron::session
