// SPDX-License-Identifier: Apache-2.0
// The newest pose of each participant, on the host: gathered, and forwarded together at most 90
// times a second, so that each receiver gets one message with all new poses.
//
// Pure; time is passed in.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "session/request_budget.h"
#include "wire/envelope.h"
#include "wire/person_pose.h"

namespace theatron::session {

class PoseBoard {
public:
    // Time between two calls of gather() that return poses.
    static constexpr Duration period = Duration(11'111);
    // Poses of one participant: a second, and at once; more ends its connection.
    static constexpr RequestBudget::Limit limit{300, 600};
    // Largest difference of a pose's time ahead of the host's time.
    static constexpr Duration max_pose_lead = std::chrono::seconds(1);

    enum class Answer : std::uint8_t { kept, ignored, flood };
    // A state came from `sender`. All but its own newest pose are ignored.
    Answer put(ParticipantId sender, const wire::State& state, TimePoint now);

    // The participant has left: the others get a pose without parts.
    void remove(ParticipantId participant, TimePoint now);

    // The time to call gather(); empty while no pose is new.
    std::optional<TimePoint> due() const;

    struct Entry {
        ParticipantId participant{};
        wire::State state;
    };
    // The poses that are new since the last call. The views are valid until the next call of put(),
    // remove() or gather().
    std::vector<Entry> gather(TimePoint now);
    // All known poses, for a participant that joins.
    std::vector<Entry> all() const;

private:
    struct Person {
        Bytes body;
        TimePoint time;
        bool is_new = false, has_left = false;
        TokenBucket budget{limit.per_second, limit.at_once};
    };
    void note_new(Person& person, TimePoint now);

    std::map<ParticipantId, Person> people_;
    std::vector<Bytes> left_;  // bodies of those who left, while gather()'s views are valid
    std::optional<TimePoint> new_since_;
    TimePoint gathered_;
};

}  // namespace theatron::session
