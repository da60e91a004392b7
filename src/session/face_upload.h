// SPDX-License-Identifier: Apache-2.0
// A participant's side of showing its own face: the pieces that leave now, one group after the
// host has taken the one before. So control and voice, which go first, never wait behind more than
// a group, and pictures keep most of a slow connection.
//
// A pure state machine; time is passed in. Safe for untrusted hosts.
#pragma once

#include <memory>
#include <vector>

#include "base/time.h"
#include "wire/own_face.h"

namespace theatron::session {

class FaceUpload {
public:
    // Shortest time between two groups, and between two of which the first took long: this share
    // of the connection at most is the face's.
    static constexpr Duration group_period = std::chrono::milliseconds(90);
    static constexpr int time_share = 4;
    // Without an answer for this time the face is offered again, a few times.
    static constexpr Duration offer_patience = std::chrono::seconds(5);
    static constexpr int most_offers = 4;
    // A face that the host does not take is offered again after this time.
    static constexpr Duration refused_for = std::chrono::seconds(15);

    enum class State {
        none,        // no face is shown
        sending,     // also while there is no connection
        there,       // the host has all of it
        refused,     // the host does not take it now
        unanswered,  // the host is of an earlier version
    };
    State state() const { return state_; }

    // Null: none from now on. Precondition: 1 to wire::max_own_face_bytes, and its hash.
    void show(std::shared_ptr<const Bytes> face, const ContentHash& hash);
    const std::shared_ptr<const Bytes>& shown() const { return face_; }

    // The host knows nothing yet.
    void on_joined();
    // The host has said something of this participant's face.
    void on_answer(ByteView body, TimePoint now);

    struct Piece {
        wire::StateTopic topic{};
        std::uint32_t place = 0;  // of topic face_piece; that of own_face has the participant's id
        Bytes body;
    };
    // The pieces that leave now. Call it some ten times a second while joined.
    std::vector<Piece> take(TimePoint now);

private:
    std::shared_ptr<const Bytes> face_;
    ContentHash hash_;
    State state_ = State::none;
    bool knows_none_ = true;  // the host was not told of a face, or that there is none any more
    int offers_ = 0;          // since the last answer
    std::size_t taken_ = 0;   // bytes that the host has
    bool may_send_ = false;   // it has answered
    TimePoint sent_, next_;   // the last group, and the earliest time of another
    TimePoint refused_;
};

}  // namespace theatron::session
