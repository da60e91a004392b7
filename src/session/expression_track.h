// SPDX-License-Identifier: Apache-2.0
// The expression of one other person for display: moved evenly between the expressions that
// arrived, at rest again where no further one arrives.
//
// A pure state machine; times are session times of the participant that displays the person.
#pragma once

#include <optional>

#include "wire/face_expression.h"

namespace theatron::session {

class ExpressionTrack {
public:
    // Senders send one after this time at the latest, also of a face that does not move.
    static constexpr Duration repeated_after = std::chrono::milliseconds(500);
    // The displayed face is that of the newest expression this long after it arrived.
    static constexpr Duration way = std::chrono::milliseconds(70);
    // Without a new expression for this long a face begins to relax, at `neutral_after` it is at
    // rest, and after `gone_after` it is not shown.
    static constexpr Duration silent_after = std::chrono::milliseconds(750);
    static constexpr Duration neutral_after = std::chrono::seconds(1);
    static constexpr Duration gone_after = std::chrono::seconds(3);

    // An expression that arrived at `now`. Those that are not newer than the last one are ignored.
    void add(const wire::FaceExpression& expression, TimePoint now);

    // Nullopt before the first one, and after `gone_after`. The state is that of the newest one.
    std::optional<wire::FaceExpression> at(TimePoint now) const;
    // True while the displayed face moves although nothing arrives. It ends at `gone_after` without
    // being moving then.
    bool is_moving(TimePoint now) const;

private:
    wire::FaceExpression from_;
    std::optional<wire::FaceExpression> to_;
    TimePoint arrived_;
};

}  // namespace theatron::session
