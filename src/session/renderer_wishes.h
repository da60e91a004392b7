// SPDX-License-Identifier: Apache-2.0
// The host's renderer commands for participants: all of them, those with a name, or a single one.
// The condition of a study goes before them.
//
// A pure state machine.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/ids.h"
#include "session/renderer_choice.h"
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
    void forget(ParticipantId participant) {
        single_.erase(participant);
        conditions_.erase(participant);
    }

    // For one connection, until end_condition().
    void begin_condition(ParticipantId participant, const std::string& name,
                         const wire::SetRenderer& wish) {
        const auto before = usual(participant, name);
        Condition& condition =
            conditions_.try_emplace(participant, Condition{{}, before}).first->second;
        condition.wish = wish;
    }
    // Returns the command that holds from now on; nullopt: there was no condition.
    std::optional<wire::SetRenderer> end_condition(ParticipantId participant,
                                                   const std::string& name) {
        const auto condition = conditions_.find(participant);
        if (condition == conditions_.end())
            return std::nullopt;
        const auto before = condition->second.usual_before;
        conditions_.erase(condition);
        const auto now = usual(participant, name);
        // A command from before that did not lock was perhaps no longer the newest choice.
        return now && (now->locked || now != before) ? now : wire::SetRenderer{own_renderer, false};
    }

    // The command for this participant, if any.
    std::optional<wire::SetRenderer> of(ParticipantId participant, const std::string& name) const {
        if (const auto condition = conditions_.find(participant); condition != conditions_.end())
            return condition->second.wish;
        return usual(participant, name);
    }

private:
    struct Condition {
        wire::SetRenderer wish;
        std::optional<wire::SetRenderer> usual_before;
    };

    std::optional<wire::SetRenderer> usual(ParticipantId participant,
                                           const std::string& name) const {
        if (const auto single = single_.find(participant); single != single_.end())
            return single->second;
        if (const auto named = named_.find(name); named != named_.end())
            return named->second;
        return all_;
    }

    std::optional<wire::SetRenderer> all_;
    std::map<std::string, wire::SetRenderer> named_;
    std::map<ParticipantId, wire::SetRenderer> single_;
    std::map<ParticipantId, Condition> conditions_;
};

}  // namespace theatron::session
