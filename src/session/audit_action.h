// SPDX-License-Identifier: Apache-2.0
// Events of the audit log about participants.
#pragma once

#include <string>
#include <utility>

#include "session/admission.h"
#include "session/host_actions.h"

namespace theatron::session {

// `by`: the name of the operator who decided; empty: the participant itself.
inline action::Audit audit_of(AuditEvent::What what, ParticipantId id,
                              const Admission::Participant& participant, std::string by = "",
                              std::string detail = "") {
    return {{what, id, participant.name, participant.person, participant.role, participant.link,
             std::move(by), std::move(detail)}};
}

}  // namespace theatron::session
