// SPDX-License-Identifier: Apache-2.0
// A person is removed by the second press of "Remove" within some seconds.
#pragma once

#include <optional>

#include "base/time.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

class RemovalQuestion {
public:
    static constexpr Duration time_to_confirm = std::chrono::seconds(5);

    // The person of whom "Remove" was pressed once: RoomPanelFacts::asked_removal.
    std::optional<ParticipantId> asked(TimePoint now) const;
    // A button of this decision was pressed. True if it is to be carried out; false if it was the
    // first press of a removal, which is kept.
    bool is_meant(const Decide& decision, TimePoint now);

private:
    std::optional<ParticipantId> person_;
    TimePoint asked_;
};

}  // namespace theatron::viewer
