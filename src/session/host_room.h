// SPDX-License-Identifier: Apache-2.0
// The room of a session on the host: requests of participants go in, and what everybody must know
// comes out as actions. RoomState decides; this class speaks the messages.
//
// Pure; time is passed in.
#pragma once

#include <map>
#include <vector>

#include "session/host_actions.h"
#include "session/request_budget.h"
#include "session/room_bytes.h"
#include "session/room_state.h"
#include "wire/envelope.h"

namespace theatron::session {

class HostRoom {
public:
    // Poses of objects from one participant: a second, and at once; more ends its connection.
    static constexpr RequestBudget::Limit pose_limit{400, 800};
    // After the host's time that a pose may be for.
    static constexpr Duration max_pose_lead = std::chrono::seconds(1);

    // Goes on from `restored`. `actions` outlives this room.
    HostRoom(const RoomSnapshot& restored, std::vector<Action>& actions)
        : state_(restored), actions_(actions) {}

    // Everybody in the session is a person in the room; those with `keeps_room` are told about it.
    void join(ParticipantId id, const PersonFacts& facts, bool keeps_room);
    void leave(ParticipantId id);
    void on_request(ParticipantId id, const wire::RoomRequest& message);
    // A request that is not looked at, because there were too many.
    void refuse(ParticipantId id, const wire::RoomRequest& message);
    void send_snapshot(ParticipantId id);

    struct Forward {
        std::vector<ParticipantId> receivers;
        bool is_flood = false;
    };
    // The pose of an object has come from `id`: who gets it at once.
    Forward on_pose(ParticipantId id, const wire::State& state, TimePoint now);

    RoomSnapshot snapshot() const { return state_.snapshot(); }
    std::uint64_t revision() const { return state_.revision(); }

private:
    struct Member {
        bool keeps_room = false;
        std::uint32_t decided = 0;  // its newest request
        TokenBucket poses{pose_limit.per_second, pose_limit.at_once};
    };
    void tell(const RoomChange& change);
    void send(ParticipantId id, wire::ToParticipant message) {
        actions_.push_back(action::Send{id, std::move(message)});
    }

    RoomState state_;
    std::map<ParticipantId, Member> members_;
    std::vector<Action>& actions_;
};

}  // namespace theatron::session
