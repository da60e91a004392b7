// SPDX-License-Identifier: Apache-2.0
// How many of the window's pixels are drawn, so that looking around stays fluent on
// a slow machine: fewer where drawing takes long, all of them again when it can.
//
// A pure state machine.
#pragma once

#include <array>
#include <cstddef>

#include "base/time.h"

namespace theatron::xr {

class RenderScale {
public:
    // Of each side, from all pixels down.
    static constexpr std::array<double, 4> steps{1.0, 0.75, 0.5, 0.35};

    double scale() const { return steps[step_]; }

    // How long the last picture took, from its beginning to its presentation.
    void add(Duration drawing);

    // Something else is drawn now: what was learned no longer holds.
    void forget();

private:
    static constexpr std::size_t window = 8;

    std::array<Duration, window> times_{};
    std::size_t count_ = 0;
    Duration sum_{};
    std::size_t step_ = 0;
    std::size_t coarsest_ = steps.size() - 1;  // where going further did not help
    Duration before_{};                        // the median at the finer step, 0 if unknown
};

}  // namespace theatron::xr
