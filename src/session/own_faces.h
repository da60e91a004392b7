// SPDX-License-Identifier: Apache-2.0
// The own faces of participants, on the host: taken from their owners piece by piece, told to the
// others once they are whole, and sent to those who ask for their content. They are kept in memory
// alone, for as long as their owner is here, may be seen and shows them. Those who record get none.
//
// A pure state machine; `admission` and `actions` must outlive it.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "session/admission.h"
#include "session/host_actions.h"
#include "session/request_budget.h"
#include "wire/own_face.h"

namespace theatron::session {

class OwnFaces {
public:
    using MakeDigest = std::function<std::unique_ptr<ContentDigest>()>;

    // Faces in a session at once; one more is not taken.
    static constexpr std::size_t max_own_faces = 40;
    // States of these topics by one participant: a second, and at once; more ends its connection.
    static constexpr RequestBudget::Limit face_piece_limit{160, 640};
    // The same for new faces; one more is not taken.
    static constexpr RequestBudget::Limit new_face_limit{0.1, 4};

    // Without `make_digest` no face is taken.
    OwnFaces(MakeDigest make_digest, Admission& admission, std::vector<Action>& actions)
        : make_digest_(std::move(make_digest)), admission_(admission), actions_(actions) {}

    static bool is_topic(wire::StateTopic topic) {
        return topic == wire::StateTopic::own_face || topic == wire::StateTopic::face_piece;
    }
    // A state of these topics came from a participant who takes part. False: a flood.
    bool put(ParticipantId sender, const wire::State& state, TimePoint now);

    // The participant has come.
    void tell_all(ParticipantId participant);
    // It has other rights.
    void follow_rights(ParticipantId participant);
    void leave(ParticipantId participant) { forget(participant); }

    // Null: there is no such whole face.
    std::shared_ptr<const Bytes> content(const ContentHash& hash) const;
    bool may_have(ParticipantId participant) const;

private:
    struct Face {
        std::uint32_t size = 0;
        ContentHash hash;
        Bytes coming;
        std::unique_ptr<ContentDigest> digest;
        std::shared_ptr<const Bytes> whole;  // null: it is not all here

        std::size_t received() const { return whole ? whole->size() : coming.size(); }
    };
    void on_offer(ParticipantId owner, const wire::OwnFace& offer, TimePoint now);
    void on_piece(ParticipantId owner, Face& face, const wire::State& piece);
    void forget(ParticipantId owner);
    void tell(ParticipantId receiver, ParticipantId owner, const wire::OwnFace& face);
    void tell_others(ParticipantId owner, const wire::OwnFace& face);
    void answer(ParticipantId owner, const Face& face);

    struct Budget {
        TokenBucket states{face_piece_limit.per_second, face_piece_limit.at_once};
        TokenBucket faces{new_face_limit.per_second, new_face_limit.at_once};
    };

    const MakeDigest make_digest_;
    Admission& admission_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, Face> faces_;
    std::map<ParticipantId, Budget> budgets_;
};

}  // namespace theatron::session
