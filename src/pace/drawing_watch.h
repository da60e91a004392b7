// SPDX-License-Identifier: Apache-2.0
// The rules by which drawing counts as standing still, without clock and threads.
#pragma once

#include <optional>

#include "base/time.h"

namespace theatron::pace {

// A live picture that is older stands still, and is covered with its age.
inline constexpr Duration still_after = std::chrono::seconds(2);
// Where nothing can cover it the program is ended.
inline constexpr Duration uncovered_end_after = std::chrono::seconds(5);

class DrawingWatch {
public:
    // The picture on screen is right at this moment: it was drawn, or nothing in it has changed.
    void beat(TimePoint now) { beat_ = now; }
    // No picture is shown that could be taken for live, until the next beat().
    void rest() { beat_.reset(); }

    // How long nothing was drawn, if that is too long.
    std::optional<Duration> still(TimePoint now) const {
        if (!beat_ || now - *beat_ < still_after)
            return std::nullopt;
        return now - *beat_;
    }

private:
    std::optional<TimePoint> beat_;
};

}  // namespace theatron::pace
