// SPDX-License-Identifier: Apache-2.0
// How the host wants participants to draw: all of them, those of a name, or a single one.
//
// A pure state machine.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/ids.h"
#include "wire/control.h"

namespace theatron::session {

class RendererWishes {
public:
    // Of everybody, also of those that join later. Forgets what was said about others.
    void set(const wire::SetRenderer& wish) {
        all_ = wish;
        named_.clear();
        single_.clear();
    }
    // Of those with this name, now and when they join again.
    void set(const std::string& name, const wire::SetRenderer& wish) { named_[name] = wish; }
    // Of one connection.
    void set(ParticipantId participant, const wire::SetRenderer& wish) {
        single_[participant] = wish;
    }
    // A number is of one connection; what is said of its name may hold again.
    void forget(ParticipantId participant) { single_.erase(participant); }

    // Nothing as long as nothing was said that concerns this participant.
    std::optional<wire::SetRenderer> of(ParticipantId participant, const std::string& name) const {
        if (const auto single = single_.find(participant); single != single_.end())
            return single->second;
        if (const auto named = named_.find(name); named != named_.end())
            return named->second;
        return all_;
    }

private:
    std::optional<wire::SetRenderer> all_;
    std::map<std::string, wire::SetRenderer> named_;
    std::map<ParticipantId, wire::SetRenderer> single_;
};

}  // namespace theatron::session
