// SPDX-License-Identifier: Apache-2.0
// How participants draw, as far as the host decides: tells each the command for it.
//
// A pure state machine; `admission` and `actions` must outlive it.
#pragma once

#include <string>
#include <vector>

#include "session/admission.h"
#include "session/host_actions.h"
#include "session/renderer_wishes.h"

namespace theatron::session {

class Renderers {
public:
    Renderers(Admission& admission, std::vector<Action>& actions)
        : admission_(admission), actions_(actions) {}

    // As in RendererWishes; told to those whom it concerns.
    void set(const wire::SetRenderer& wish);
    void set(ParticipantId participant, const wire::SetRenderer& wish);
    // Also of the participant who is shown under this name.
    void set(const std::string& name, const wire::SetRenderer& wish);
    void forget(ParticipantId participant) { wishes_.forget(participant); }

    // A study sets it, for this connection; see RendererWishes.
    void begin_condition(ParticipantId participant, const wire::SetRenderer& wish);
    void end_condition(ParticipantId participant);

    // Tells the participant its renderer, if the host has ever set one.
    void tell(ParticipantId participant);

private:
    Admission& admission_;
    std::vector<Action>& actions_;
    RendererWishes wishes_;
};

}  // namespace theatron::session
