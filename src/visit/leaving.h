// SPDX-License-Identifier: Apache-2.0
// The key for leaving must be pressed twice, against leaving by accident; once is enough if no
// session is joined.
//
// Pure.
#pragma once

#include "base/time.h"

namespace theatron::visit {

class Leaving {
public:
    static constexpr Duration confirm_within = std::chrono::seconds(3);

    // True if the person leaves.
    bool pressed(bool is_joined, TimePoint now) {
        const bool again = now - pressed_at_ < confirm_within;
        pressed_at_ = now;
        return again || !is_joined;
    }

private:
    TimePoint pressed_at_ = TimePoint(-confirm_within);
};

}  // namespace theatron::visit
