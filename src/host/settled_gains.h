// SPDX-License-Identifier: Apache-2.0
// The choice of the estimates of the cameras' colour gains that are published. Each change of a
// calibration begins a segment of every recording, so gains are published once they have settled,
// and again only after a change that can be seen and stays.
//
// Pure: times are arguments, of one clock. Not thread safe.
#pragma once

#include <optional>
#include <vector>

#include "base/time.h"
#include "geometry/vec.h"

namespace theatron::host {

class SettledGains {
public:
    // Settled estimates differ by at most this share in each channel. From one to the next they
    // differ by some thousandths, more where people move.
    static constexpr double agreement = 0.015;
    // Estimates that must agree before they are published: two may have seen the same person pass.
    static constexpr int enough_estimates = 4;
    // A change by this share is 5 of 255 steps on a grey wall; blended into each other, two cameras
    // whose colours differ by less show no border.
    static constexpr double visible = 0.04;
    // A change that lasts for this time is published: a person who works beside a camera, or a lamp
    // that is turned to it, is gone before. It also limits how often recordings begin segments.
    static constexpr Duration lasting = std::chrono::seconds(60);

    // By camera; nullopt: it was compared with no other camera, or keeps the gain it has.
    using Gains = std::vector<std::optional<Vec3>>;

    // Takes a further estimate: factors near 1, for the same cameras each time. Returns the gains
    // that are to be published now; empty: none are.
    Gains add(const Gains& estimate, TimePoint now);

    // Those that were published last; all nullopt before.
    const Gains& published() const { return published_; }
    bool has_published() const { return has_published_; }

private:
    bool is_visible_change(const Gains& estimate) const;
    bool agrees(const Gains& estimate) const;
    Gains mean() const;

    Gains published_;
    bool has_published_ = false;
    std::vector<Gains> agreeing_;  // the newest estimates, all of a change once there are gains
    TimePoint since_;              // when the first of those that agree came
};

}  // namespace theatron::host
