// SPDX-License-Identifier: Apache-2.0
#include "session/renderers.h"

namespace theatron::session {

void Renderers::tell(ParticipantId id) {
    if (const auto wish = wishes_.of(id, admission_.find(id)->given_name))
        actions_.push_back(action::Send{id, *wish});
}

void Renderers::set(const wire::SetRenderer& wish) {
    wishes_.set(wish);
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part())
            tell(id);
}

void Renderers::set(ParticipantId id, const wire::SetRenderer& wish) {
    const Admission::Participant* participant = admission_.find(id);
    if (!participant || !participant->takes_part())
        return;
    wishes_.set(id, wish);
    tell(id);
}

void Renderers::begin_condition(ParticipantId id, const wire::SetRenderer& wish) {
    wishes_.begin_condition(id, admission_.find(id)->given_name, wish);
    tell(id);
}

void Renderers::end_condition(ParticipantId id) {
    if (const auto wish = wishes_.end_condition(id, admission_.find(id)->given_name))
        actions_.push_back(action::Send{id, *wish});
}

void Renderers::set(const std::string& name, const wire::SetRenderer& wish) {
    wishes_.set(name, wish);
    for (const auto& [id, participant] : admission_.participants()) {
        if (!participant.takes_part())
            continue;
        if (participant.given_name == name) {
            wishes_.forget(id);
            tell(id);
        } else if (participant.name == name) {
            set(id, wish);
        }
    }
}

}  // namespace theatron::session
