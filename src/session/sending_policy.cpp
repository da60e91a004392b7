// SPDX-License-Identifier: Apache-2.0
#include "session/sending_policy.h"

#include <algorithm>
#include <cassert>

namespace theatron::session {
namespace {

// Shares of the link's rate. The gap between the two prevents an oscillation of the steps.
constexpr double share_to_stay = 0.85;
constexpr double share_to_go_up = 0.7;
constexpr double ceiling_to_go_up = 0.9;
// A step that needs more than this many times the measured rate is not tried.
constexpr double hopeless = 1.5;
// A link whose rate grew by this factor since a failed trial counts as another link.
constexpr double clearly_better = 1.3;

// A single late frame may be chance, and BBR's probing (for a fifth of a second, every ten
// seconds) is not a slow link.
constexpr int late_measures = 3;
// A browser's page that loads takes nothing for up to half a second, whatever its link carries: it
// compiles its shaders when the first frames arrive.
constexpr Duration at_first = std::chrono::seconds(2);
constexpr int loading_measures = 6;  // measures in a row without an answer
constexpr Duration shortest_settling = std::chrono::milliseconds(400);
constexpr Duration time_of_bbr = std::chrono::milliseconds(300);
constexpr Duration calm_to_go_up = std::chrono::milliseconds(600);
// Before trials of a receiver with which none has failed. Nothing shows the rate of a link that
// holds nothing back, as behind a pause of the receiver: a browser's page that loads takes nothing
// for tenths of a second.
constexpr Duration calm_to_try = std::chrono::seconds(1);
constexpr Duration longest_patience = std::chrono::seconds(60);
// Smallest time of a goal that is left for the sender's own queue.
constexpr Duration smallest_margin = std::chrono::milliseconds(40);

Duration predicted_delay(const LinkMeasure& link, const StepNeed& need) {
    const double seconds =
        link.bytes_per_second > 0 ? need.bytes_at_once / link.bytes_per_second : 0;
    return link.round_trip / 2 + seconds_to_duration(std::min(seconds, 100.0));
}

bool carries(const LinkMeasure& link, const StepNeed& need, double share) {
    return link.bytes_per_second <= 0 || need.bytes_per_second <= share * link.bytes_per_second;
}

// A goal that even the last step cannot reach would only lower the quality.
Duration reachable_goal(const LinkMeasure& link, std::span<const StepNeed> needs, Duration goal) {
    return std::max(goal, predicted_delay(link, needs.back()) + smallest_margin);
}

}  // namespace

void SendingPolicy::go(int step, SendingReason reason, TimePoint now) {
    step_ = step;
    reason_ = reason;
    late_in_a_row_ = 0;
    calm_since_ = now;
}

// True if the step down that follows takes back a step up that was too much.
bool SendingPolicy::fail_trial(const LinkMeasure& link) {
    if (!trying_)
        return false;
    trying_ = false;
    has_failed_ = true;
    History& history = history_[std::size_t(step_)];
    history.patience = std::min(2 * history.patience, longest_patience);
    history.failed = true;
    history.carried = link.bytes_per_second;
    return true;
}

bool SendingPolicy::is_late(const LinkMeasure& link, Duration goal, TimePoint now) {
    if (!began_)
        began_ = now;
    paused_ = link.takes_nothing ? paused_ + 1 : 0;
    if (paused_ > 0 && paused_ <= loading_measures && now - *began_ < at_first)
        return false;
    // A step that is only tried and loses frames is too much, even if those that get through are
    // in time.
    const bool late = link.delay > goal || (trying_ && link.dropped > 0);
    late_in_a_row_ = late ? late_in_a_row_ + 1 : 0;
    return late_in_a_row_ >= late_measures;
}

// The best step below the present one that the link is measured to carry in time.
int SendingPolicy::step_for(const LinkMeasure& link, std::span<const StepNeed> needs,
                            Duration goal) const {
    const int last = int(needs.size()) - 1;
    for (int s = step_ + 1; s < last; ++s) {
        const StepNeed& need = needs[std::size_t(s)];
        if (carries(link, need, share_to_stay) && predicted_delay(link, need) <= goal)
            return s;
    }
    return last;
}

bool SendingPolicy::update(const LinkMeasure& link, std::span<const StepNeed> needs,
                           const SendingGoal& goal, TimePoint now) {
    assert(!needs.empty());
    const int before = step_;
    const int last = int(needs.size()) - 1;
    step_ = std::min(step_, last);
    history_.resize(needs.size());
    const auto need = [&](int s) { return needs[std::size_t(s)].bytes_per_second; };

    // A step that failed before has to hold for as long as it had to wait.
    if (trying_ && now - went_up_ > history_[std::size_t(step_)].patience) {
        trying_ = false;
        history_[std::size_t(step_)] = {};
    }

    if (goal.max_bytes_per_second > 0 && step_ < last && need(step_) > goal.max_bytes_per_second) {
        int s = step_ + 1;
        while (s < last && need(s) > goal.max_bytes_per_second)
            ++s;
        fail_trial(link);
        go(s, SendingReason::ceiling, now);
        settled_ = now + shortest_settling;
        return true;
    }

    const bool wanted = goal.latency > Duration(0);
    const Duration reachable = reachable_goal(link, needs, goal.latency);
    const bool late = wanted && is_late(link, reachable, now);
    if (link.delay > reachable || link.dropped > 0)
        calm_since_ = now;
    if (late && now >= settled_ && step_ < last) {
        // The link most likely still carries the step before the trial.
        const bool back = fail_trial(link) && carries(link, needs[std::size_t(step_ + 1)], 1);
        if (back)
            go(step_ + 1, SendingReason::trial_failed, now);
        else
            go(step_for(link, needs, reachable), SendingReason::late, now);
        // Bytes in flight must arrive before the step has an effect; a link that just
        // carries the step takes longer for that.
        settled_ = now + (back ? 2 : 1) * shortest_settling + 2 * link.round_trip;
        return true;
    }
    return (step_ > 0 && step_up(link, needs, goal, reachable, now)) || step_ != before;
}

bool SendingPolicy::step_up(const LinkMeasure& link, std::span<const StepNeed> needs,
                            const SendingGoal& goal, Duration reachable, TimePoint now) {
    const StepNeed& better = needs[std::size_t(step_ - 1)];
    if (goal.max_bytes_per_second > 0 &&
        better.bytes_per_second > ceiling_to_go_up * goal.max_bytes_per_second)
        return false;
    const bool known = link.bytes_per_second > 0;
    const bool has_room = known && carries(link, better, share_to_go_up) &&
                          predicted_delay(link, better) <= reachable - smallest_margin / 2;
    if (!has_room && !carries(link, better, hopeless))
        return false;
    const History& history = history_[std::size_t(step_ - 1)];
    const bool better_link =
        history.carried > 0 && link.bytes_per_second > clearly_better * history.carried;
    const Duration calm = has_room && (!history.failed || better_link) ? calm_to_go_up
                          : has_failed_                                ? history.patience
                                                                       : calm_to_try;
    if (now - calm_since_ < calm)
        return false;
    trying_ = true;
    went_up_ = now;
    // On a link that loses packets the sender goes by BBR, which needs some round trips to find a
    // higher rate than the one that it was offered before.
    if (link.loses_packets)
        settled_ = now + time_of_bbr + 8 * link.round_trip;
    go(step_ - 1, has_room ? SendingReason::room : SendingReason::trial, now);
    return true;
}

}  // namespace theatron::session
