// SPDX-License-Identifier: Apache-2.0
#include "session/voice_floor.h"

namespace theatron::session {

VoiceFloor::Forward VoiceFloor::on_voice(ParticipantId speaker, HostSession& session,
                                         TimePoint now) {
    Speaker& known = speakers_[speaker];
    if (!known.budget.take(now))
        return {{}, !known.patience.take(now)};
    if (!session.allow(speaker, Right::speak))
        return {};
    Forward forward;
    for (const auto& [id, participant] : session.participants())
        if (id != speaker && participant.takes_part() &&
            !participant.has(wire::Feature::sends_only))
            forward.receivers.push_back(id);
    return forward;
}

}  // namespace theatron::session
