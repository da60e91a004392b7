// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, at a participant: the messages that have come, and
// its own that the host may not have yet. Those are sent again until they come back.
//
// Pure; time is passed in. Not thread safe.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "wire/control.h"

namespace theatron::session {

class MemberChat {
public:
    // Messages that are kept, and own ones that are not sent yet.
    static constexpr std::size_t max_kept = 200, max_unsent = 8;
    static constexpr Duration repeated_after = std::chrono::seconds(3);

    // A connection has begun, or has ended.
    void on_connected();
    // Returns those that are new. They come in the order in which the host had them.
    std::vector<wire::ChatMessage> take(const wire::ChatMessages& message);

    // `id` is random. False: nothing of it is visible, or too many messages wait.
    bool write(const std::string& text, std::uint64_t id);
    // The message that is to be sent now; one after the other, in their order.
    std::optional<wire::WriteChat> due(TimePoint now);
    // Goes on with what the person had written in an earlier program of the same stay: ids of own
    // messages, and those that the host may not have yet. Those that write() refuses are left out.
    void go_on(const std::vector<std::uint64_t>& own, const std::vector<wire::WriteChat>& unsent);
    // The person may not write any more. Returns the texts that are not sent.
    std::vector<std::string> give_up();

    const std::deque<wire::ChatMessage>& messages() const { return messages_; }
    const std::deque<wire::WriteChat>& unsent() const { return unsent_; }
    // True of a message that was written here, on whichever connection.
    bool is_own(std::uint64_t id) const { return own_.contains(id); }
    // Grows with each change.
    std::uint64_t version() const { return version_; }

private:
    std::deque<wire::ChatMessage> messages_;
    std::deque<wire::WriteChat> unsent_;
    std::set<std::uint64_t> own_;    // of both, and those that were given up
    std::optional<TimePoint> sent_;  // the first of them
    std::uint64_t version_ = 0;
};

}  // namespace theatron::session
