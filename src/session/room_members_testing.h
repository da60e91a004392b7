// SPDX-License-Identifier: Apache-2.0
// A host's room with its members' rooms, for tests: messages arrive at once.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "session/host_room.h"
#include "session/member_room.h"

namespace theatron::session {

class RoomMembers : public ::testing::Test {
protected:
    void join(ParticipantId id, Role role, const std::string& name = "person",
              const Bytes& person = {}) {
        members[id].begin(id);
        host.join(id, {role, false, name}, true, {}, person);
        deliver();
    }
    void deliver() {
        for (bool more = true; std::exchange(more, false);) {
            for (const Action& next : std::exchange(actions, {})) {
                const auto& send = std::get<action::Send>(next);
                members[send.participant].on_message(send.message);
                more = true;
            }
            for (auto& [id, member] : members)
                for (const wire::RoomRequest& request : member.take_requests()) {
                    host.on_request(id, request);
                    more = true;
                }
        }
    }
    Refusal ask(ParticipantId by, const Request& request) {
        members[by].ask(request);
        deliver();
        const auto refusal = members[by].take_refusal();
        return refusal ? refusal->second : Refusal::none;
    }

    std::vector<Action> actions;
    HostRoom host{{}, actions};
    std::map<ParticipantId, MemberRoom> members;
};

}  // namespace theatron::session
