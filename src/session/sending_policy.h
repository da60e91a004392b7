// SPDX-License-Identifier: Apache-2.0
// Chooses a receiver's step on a ladder from measurements of its link.
// session/delivery.h defines the meaning of the steps.
// A pure state machine.
//
// Down: at once when the ceiling is exceeded; when frames arrive too late, to the
// first step that the link is measured to carry. Up: one step at a time, when
// the measured link has room for it, else as a trial. A step up that fails is
// taken back, and the next time to that step waits twice as long unless the link
// has become better, so nothing swings. Before the first one that fails, trials come soon.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"

namespace theatron::session {

// A measurement of one receiver's link since the one before.
struct LinkMeasure {
    double bytes_per_second = 0;  // rate of the link; 0 while not known
    Duration round_trip{};        // of the link without queues
    Duration delay{};             // the longest of a frame, from encoded to arrived
    int dropped = 0;              // frames that were dropped because the link was too slow
    bool takes_nothing = false;   // frames wait for the receiver, and it has taken nothing
    bool loses_packets = false;   // by chance, and not because it is full
};

// The rate that a step of the ladder needs.
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
    // Call it ten times a second. `needs` has one entry for each step, at least one;
    // the first is for all that was requested. True if step() changed.
    bool update(const LinkMeasure& link, std::span<const StepNeed> needs, const SendingGoal& goal,
                TimePoint now);

    // The receiver has changed: what failed before says nothing.
    void forget_failures() {
        history_.assign(history_.size(), {});
        has_failed_ = false;
    }

    // The ladder has changed and has this number of steps now.
    void limit(int steps) { step_ = std::min(step_, steps - 1); }

    int step() const { return step_; }
    SendingReason reason() const { return reason_; }

private:
    void go(int step, SendingReason reason, TimePoint now);
    bool fail_trial(const LinkMeasure& link);
    int step_for(const LinkMeasure& link, std::span<const StepNeed> needs, Duration goal) const;
    bool is_late(const LinkMeasure& link, Duration goal, TimePoint now);
    bool step_up(const LinkMeasure& link, std::span<const StepNeed> needs, const SendingGoal& goal,
                 Duration reachable, TimePoint now);

    int step_ = 0;
    SendingReason reason_ = SendingReason::none;
    int late_in_a_row_ = 0;
    std::optional<TimePoint> began_;  // the first measure
    int paused_ = 0;                  // measures in a row in which the receiver took nothing
    TimePoint settled_;               // no other step down before
    TimePoint calm_since_;            // nothing late and nothing dropped
    bool trying_ = false;             // the last step up is still a trial
    bool has_failed_ = false;         // any trial yet
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
