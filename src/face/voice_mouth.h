// SPDX-License-Identifier: Apache-2.0
// A mouth that is guessed from the loudness of the person's voice, where no tracker sees it, and
// lids that blink where no tracker sees them. Neither says anything about the person.
//
// Pure; time is passed in.
#pragma once

#include <optional>

#include "base/time.h"

namespace theatron::face {

class VoiceMouth {
public:
    // From this level of the voice on the jaw opens, and at the loud level it is open as far as in
    // loud speech.
    static constexpr int quiet_db = -48, loud_db = -18;
    static constexpr float widest = 0.55F;
    // A mouth opens faster than it closes.
    static constexpr Duration opens_within = std::chrono::milliseconds(40),
                              closes_within = std::chrono::milliseconds(110);

    // The open jaw, 0 to 1, at `now`, when the voice is this loud (decibels below full scale);
    // times do not go back.
    float put(int level_db, TimePoint now);

private:
    float open_ = 0;
    std::optional<TimePoint> at_;
};

// The closed lids, 0 to 1, of somebody who blinks every few seconds, unevenly; `seconds` from any
// beginning, not negative.
float idle_blink(double seconds);

}  // namespace theatron::face
