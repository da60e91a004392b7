// SPDX-License-Identifier: Apache-2.0
// The host's renderer commands for participants: all of them, those with a name, or a single one.
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
    // For all participants, also those that join later. Removes the commands for single ones.
    void set(const wire::SetRenderer& wish) {
        all_ = wish;
        named_.clear();
        single_.clear();
    }
    // For participants with this name, now and when they join again.
    void set(const std::string& name, const wire::SetRenderer& wish) { named_[name] = wish; }
    // For one connection.
    void set(ParticipantId participant, const wire::SetRenderer& wish) {
        single_[participant] = wish;
    }
    // A participant has left. A command for its name stays.
    void forget(ParticipantId participant) { single_.erase(participant); }

    // The command for this participant, if any.
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
