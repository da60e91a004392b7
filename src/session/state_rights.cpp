// SPDX-License-Identifier: Apache-2.0
#include "session/state_rights.h"

#include "wire/face_expression.h"
#include "wire/person_pose.h"

namespace theatron::session {

using wire::StateTopic;

std::optional<Right> needed_right(const wire::State& state) {
    if (state.key.topic == StateTopic::expression) {
        const auto expression = wire::decode_face_expression(state.body);
        const bool shows = expression && expression->state != wire::FaceExpression::State::none;
        return shows ? std::optional(Right::be_seen) : std::nullopt;
    }
    if (state.key.topic == StateTopic::object)
        return std::nullopt;
    const auto pose = wire::decode_person_pose(state.body);
    const bool points = pose && (pose->left_hand || pose->right_hand || pose->calls);
    return points ? std::optional(Right::point) : std::nullopt;
}

Bytes without_right(const wire::State& state, TimePoint time) {
    if (state.key.topic == StateTopic::expression) {
        wire::FaceExpression nothing;
        nothing.time = time;
        return wire::encode_face_expression(nothing);
    }
    auto pose = wire::decode_person_pose(state.body);
    if (!pose)
        return {};
    pose->time = time;
    pose->left_hand.reset();
    pose->right_hand.reset();
    pose->calls = false;
    return wire::encode_person_pose(*pose);
}

}  // namespace theatron::session
