// SPDX-License-Identifier: Apache-2.0
// How much of what a receiver asked for it gets: which step of a ladder, from
// what was measured of its link. A pure state machine; what the steps are is the
// business of session/delivery.h.
//
// Down: at once when the ceiling is exceeded; when frames arrive too late, to the
// first step that the link is measured to carry. Up: one step at a time, when
// the measured link has room for it, else as a trial. A step up that fails is
// taken back, and the next time to that step waits twice as long unless the link
// has become better, so nothing swings.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/time.h"

namespace theatron::session {

// Of one receiver's link since the last measurement.
struct LinkMeasure {
    double bytes_per_second = 0;  // what the link carries; 0 while not known
    Duration round_trip{};        // the link's own
    Duration delay{};             // the longest of a frame, from encoded to arrived
    int dropped = 0;              // frames given up because they could not be sent in time
};

// What a step of the ladder takes.
struct StepNeed {
    double bytes_per_second = 0;
    double bytes_at_once = 0;  // of the frames of one moment
};

struct SendingGoal {
    Duration latency{};               // from encoded to arrived; 0: never step down for it
    double max_bytes_per_second = 0;  // 0: no ceiling
};

enum class SendingReason { none, late, ceiling, room, trial, trial_failed };

class SendingPolicy {
public:
    // Call ten times a second. `needs` has one entry for each step, the first is
    // all that was asked for; there is at least one. True if step() changed.
    bool update(const LinkMeasure& link, std::span<const StepNeed> needs, const SendingGoal& goal,
                TimePoint now);

    // The ladder has changed and has so many steps now.
    void limit(int steps) { step_ = std::min(step_, steps - 1); }

    int step() const { return step_; }
    SendingReason reason() const { return reason_; }

private:
    void go(int step, SendingReason reason, TimePoint now);
    bool fail_trial(const LinkMeasure& link);
    int step_for(const LinkMeasure& link, std::span<const StepNeed> needs, Duration goal) const;
    bool is_late(const LinkMeasure& link, Duration goal);
    bool step_up(const LinkMeasure& link, std::span<const StepNeed> needs, const SendingGoal& goal,
                 Duration reachable, TimePoint now);

    int step_ = 0;
    SendingReason reason_ = SendingReason::none;
    int late_in_a_row_ = 0;
    TimePoint settled_;     // no other step down before
    TimePoint calm_since_;  // nothing late and nothing dropped
    bool trying_ = false;   // the last step up has not proved itself yet
    TimePoint went_up_;

    static constexpr Duration first_patience = std::chrono::seconds(3);
    struct History {
        Duration patience = first_patience;  // before a trial, and until it is proved
        bool failed = false;                 // the last trial
        double carried = 0;                  // by the link when it failed
    };
    std::vector<History> history_;  // by step
};

}  // namespace theatron::session
