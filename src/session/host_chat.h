// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, on the host: sent to everybody who takes part and
// shows it. The newest messages are kept in memory alone, for those whose connection was lost
// meanwhile. Somebody who comes later is not told what was written before.
//
// A pure state machine; `admission` and `actions` must outlive it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "session/admission.h"
#include "session/host_actions.h"

namespace theatron::session {

class HostChat {
public:
    // Messages, and runs of programs (wire::Join::run), that are kept; the oldest are forgotten.
    static constexpr std::size_t max_kept = 100, max_runs = 512;

    HostChat(Admission& admission, std::vector<Action>& actions)
        : admission_(admission), actions_(actions) {}

    // The participant has come, or may have missed messages: it is sent those that are kept from
    // the time since its run came first.
    void join(ParticipantId participant);
    // The participant, who may write, has written. A text without a visible character is ignored; a
    // repeated one goes to its author alone.
    void write(ParticipantId author, const wire::WriteChat& written, TimePoint now);
    // Another session begins.
    void clear();

private:
    struct Kept {
        std::uint64_t number = 0;
        wire::ChatMessage message;
    };
    void send(ParticipantId participant, std::vector<wire::ChatMessage> messages);

    Admission& admission_;
    std::vector<Action>& actions_;
    std::deque<Kept> kept_;
    std::uint64_t count_ = 0;                      // of messages so far
    std::map<std::uint64_t, std::uint64_t> runs_;  // and count_ when each came first
};

}  // namespace theatron::session
