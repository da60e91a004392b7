// SPDX-License-Identifier: Apache-2.0
// A person is removed, and what a person has made, by the second press of the button within some
// seconds.
#pragma once

#include <optional>

#include "base/time.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

class RemovalQuestion {
public:
    static constexpr Duration time_to_confirm = std::chrono::seconds(5);

    // The decision of which the button was pressed once: RoomPanelFacts::asked.
    std::optional<Decide> asked(TimePoint now) const;
    // A button of this decision was pressed. True if it is to be carried out; false if it was the
    // first press of a removal, which is kept.
    bool is_meant(const Decide& decision, TimePoint now);

private:
    std::optional<Decide> pressed_;
    TimePoint pressed_at_;
};

}  // namespace theatron::viewer
