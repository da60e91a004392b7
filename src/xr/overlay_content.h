// SPDX-License-Identifier: Apache-2.0
// The texts over the picture: a line of facts at the bottom, a message in the
// middle, what was just chosen, and the help.
#pragma once

#include <string>
#include <vector>

namespace theatron::xr {

// One field of the line at the bottom.
struct Fact {
    std::string label, value;
    bool warning = false;

    bool operator==(const Fact&) const = default;
};

struct OverlayContent {
    std::vector<Fact> facts;
    // Large in the middle, over a darkened picture, with a smaller line below.
    std::string message, detail;
    std::string warning;  // at the top, as long as it holds
    std::string notice;   // below it, for what just happened
    bool help = false;

    bool operator==(const OverlayContent&) const = default;
};

}  // namespace theatron::xr
