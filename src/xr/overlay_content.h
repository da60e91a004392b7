// SPDX-License-Identifier: Apache-2.0
// The texts over the picture: a line of facts at the bottom, a message in the
// middle, notices, and the help.
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
    std::string warning;  // at the top, while its cause lasts
    std::string notice;   // below it, for a recent event
    bool help = false;

    bool operator==(const OverlayContent&) const = default;
};

}  // namespace theatron::xr
