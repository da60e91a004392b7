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
    const auto& participants = session.participants();
    const bool may_record = participants.at(speaker).voice_recorded;
    for (const auto& [id, participant] : participants)
        if (id != speaker && participant.takes_part() &&
            !participant.has(wire::Feature::sends_only) && (may_record || !participant.records))
            forward.receivers.push_back(id);
    return forward;
}

std::vector<ParticipantId> VoiceFloor::listeners_of_replay(const HostSession& session) {
    std::vector<ParticipantId> listeners;
    for (const auto& [id, participant] : session.participants())
        if (participant.takes_part() && !participant.has(wire::Feature::sends_only) &&
            !participant.records)
            listeners.push_back(id);
    return listeners;
}

}  // namespace theatron::session
