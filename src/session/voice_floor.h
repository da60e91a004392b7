// SPDX-License-Identifier: Apache-2.0
// Decides on the host who hears a packet of voice: nobody if its speaker is muted or has a role
// that may not speak, otherwise everybody else in the session. Recorders hear only those who
// agree to be recorded. Packets are not decoded.
//
// Pure; time is passed in.
#pragma once

#include <map>
#include <vector>

#include "session/host_session.h"

namespace theatron::session {

class VoiceFloor {
public:
    // Packets of one participant: a second, and at once; further ones are dropped. A speaker sends
    // at most 100 a second.
    static constexpr RequestBudget::Limit limit{150, 100};
    // Those beyond: a second, and at once; one more ends the connection.
    static constexpr RequestBudget::Limit patience_limit{100, 2000};

    struct Forward {
        std::vector<ParticipantId> receivers;
        bool is_flood = false;
    };
    // A packet of voice came from this participant.
    Forward on_voice(ParticipantId speaker, HostSession& session, TimePoint now);
    // The receivers of the voices of a recording that the host plays: no recorder, because their
    // speakers agreed to that recording only.
    static std::vector<ParticipantId> listeners_of_replay(const HostSession& session);
    void remove(ParticipantId participant) { speakers_.erase(participant); }

private:
    struct Speaker {
        TokenBucket budget{limit.per_second, limit.at_once};
        TokenBucket patience{patience_limit.per_second, patience_limit.at_once};
    };
    std::map<ParticipantId, Speaker> speakers_;
};

}  // namespace theatron::session
