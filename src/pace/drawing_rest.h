// SPDX-License-Identifier: Apache-2.0
// Leaves the processor to decoding on a machine that cannot do both: says how long drawing rests
// between two pictures.
//
// A frame that is not decoded in time is lost to this participant; with fewer pictures the view
// only moves less fluently. So while frames are left out, a smaller share of the time is drawn. If
// that brings no frames back, as on a narrow link, the time is given back to drawing.
//
// A pure state machine. Its inputs are the processor time of each picture, which is small where a
// graphics card draws, and what comes in.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/time.h"

namespace theatron::pace {

// Measurements of a participant, several times a second.
struct Receiving {
    bool is_behind = false;        // frames of cameras are left out for this participant
    double frames_per_second = 0;  // decoded, of the slowest live camera
    double age_ms = 0;             // of the newest frame when it was decoded; 0: not known
};

class DrawingRest {
public:
    // Shares of the time that drawing may take, by step.
    static constexpr std::array<double, 3> shares{1, 0.5, 0.25};
    // Rest alone never leads to fewer pictures a second.
    static constexpr double fewest_per_second = 2.5;
    // Drawing that takes a smaller share of the time costs no frames.
    static constexpr double small_share = 0.15;
    // Time without a lost frame before more is drawn: twice as long after each time that this was
    // too much, and the first again once it was not for `held`.
    static constexpr Duration first_patience = 4s, longest_patience = 256s, held = 60s;
    // A step up is undone if the age of frames grows `times_as_old`-fold and by `more_ms`, which
    // happens before any is lost.
    static constexpr double times_as_old = 2, more_ms = 20;
    // Within `proof` after the last step the frame rate must reach `gain` times the earlier one;
    // else each picture is drawn for `first_pause`, then for twice as long.
    static constexpr Duration proof = 8s, first_pause = 30s, longest_pause = 480s;
    static constexpr double gain = 1.1;

    // With `begins_resting` the last step is the first one: for a processor that draws, and has
    // most to do at the beginning.
    explicit DrawingRest(bool begins_resting = false)
        : step_(begins_resting ? shares.size() - 1 : 0) {}

    // A picture was begun and took this time of the processor.
    void add(TimePoint begun, Duration processor);
    void observe(const Receiving& receiving, TimePoint now);

    // No picture should begin before.
    TimePoint next() const { return next_; }
    bool rests_until_later(TimePoint now) const { return now < next_; }
    std::size_t step() const { return step_; }

private:
    static constexpr Duration settling = 600ms;  // of what comes in, behind a step

    void go(std::size_t step, TimePoint now);
    void go_down(const Receiving& receiving, TimePoint now);
    void judge(const Receiving& receiving, TimePoint now);
    bool is_too_much(const Receiving& receiving);
    bool draws_much() const { return share_ >= small_share; }

    std::size_t step_;
    TimePoint next_;

    std::optional<TimePoint> begun_;  // the last picture
    Duration took_{};
    double share_ = 0;  // of the time, without rest; newer pictures weigh more

    std::optional<TimePoint> calm_since_;  // nothing was left out
    TimePoint stepped_, not_before_;
    bool came_up_ = false;                // the last step was up
    double age_ms_ = 0;                   // of frames without loss; newer ones weigh more
    std::optional<double> before_;        // frames a second when it began to rest
    Duration patience_ = first_patience;  // before a step up
    Duration pause_ = first_pause;
};

}  // namespace theatron::pace
