// SPDX-License-Identifier: Apache-2.0
// The newest pose and facial expression of each participant, on the host: gathered, and forwarded
// together at most 90 times a second, so that each receiver gets one message with all new ones.
//
// Pure; time is passed in.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "session/permissions.h"
#include "session/request_budget.h"
#include "wire/envelope.h"

namespace theatron::session {

class PoseBoard {
public:
    // Time between two calls of gather() that return states.
    static constexpr Duration period = Duration(11'111);
    // Poses of one participant: a second, and at once; more ends its connection.
    static constexpr RequestBudget::Limit limit{300, 600};
    // The same for expressions, of which a participant sends at most 30 a second.
    static constexpr RequestBudget::Limit expression_limit{60, 120};
    // Largest difference of a state's time ahead of the host's time.
    static constexpr Duration max_pose_lead = std::chrono::seconds(1);

    enum class Answer : std::uint8_t { kept, ignored, flood };
    // True for the rights that a participant has.
    using May = std::function<bool(Right)>;
    // A state came from `sender`. All but its own newest pose and expression are ignored; of these
    // only what it may send is kept, and an expression only where it may be seen.
    Answer put(ParticipantId sender, const wire::State& state, const May& may, TimePoint now);

    // The participant has other rights: what it may not send any more is taken back from the others
    // and from those who join.
    void follow_rights(ParticipantId participant, const May& may, TimePoint now);

    // The participant has left: the others get a pose without parts, and an expression of state
    // `none`, of what it had sent.
    void remove(ParticipantId participant, TimePoint now);

    // The time to call gather(); empty while nothing is new.
    std::optional<TimePoint> due() const;

    struct Entry {
        ParticipantId participant{};
        wire::State state;
    };
    // The states that are new since the last call. The views are valid until the next call of
    // put(), remove() or gather().
    std::vector<Entry> gather(TimePoint now);
    // All known states, for a participant that joins.
    std::vector<Entry> all() const;

private:
    // One participant's state of one topic.
    struct Kept {
        explicit Kept(RequestBudget::Limit most) : budget(most.per_second, most.at_once) {}

        Bytes body;
        TimePoint time;
        bool is_new = false, has_left = false;
        TokenBucket budget;
    };
    void note_new(Kept& kept, TimePoint now);
    void remove(wire::StateKey key, TimePoint now);

    std::map<wire::StateKey, Kept> states_;
    std::vector<Bytes> left_;  // bodies of those who left, while gather()'s views are valid
    std::optional<TimePoint> new_since_;
    TimePoint gathered_;
};

}  // namespace theatron::session
