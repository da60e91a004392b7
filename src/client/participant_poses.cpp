// SPDX-License-Identifier: Apache-2.0
// The poses and facial expressions of a participant and of the others.
#include <utility>

#include "client/participant_shared.h"

namespace theatron::client {

void Participant::send_pose(const wire::PersonPose& pose) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client)
        return;
    const bool is_telling = shared_->own_pose.has_value();
    shared_->own_pose = pose;
    if (!is_telling)
        shared_->client->post([this] { tell_pose(); });
}

void Participant::tell_pose() {
    std::optional<wire::PersonPose> pose;
    {
        const std::lock_guard lock(shared_->mutex);
        pose = std::exchange(shared_->own_pose, std::nullopt);
    }
    if (!pose || !session_.joined())
        return;
    const Bytes body = wire::encode_person_pose(*pose);
    const auto own = std::uint32_t(session_.welcome().participant);
    const wire::State state{{wire::StateTopic::pose, own}, body};
    shared_->client->send_states({&state, 1});
}

std::map<ParticipantId, wire::PersonPose> Participant::poses() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->poses;
}

void Participant::send_expression(const wire::FaceExpression& expression) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client)
        return;
    const bool is_telling = shared_->own_expression.has_value();
    shared_->own_expression = expression;
    if (!is_telling)
        shared_->client->post([this] { tell_expression(); });
}

void Participant::tell_expression() {
    std::optional<wire::FaceExpression> expression;
    {
        const std::lock_guard lock(shared_->mutex);
        expression = std::exchange(shared_->own_expression, std::nullopt);
    }
    if (!expression || !session_.joined())
        return;
    const Bytes body = wire::encode_face_expression(*expression);
    const auto own = std::uint32_t(session_.welcome().participant);
    const wire::State state{{wire::StateTopic::expression, own}, body};
    shared_->client->send_states({&state, 1});
}

void Participant::on_expression(ParticipantId person, ByteView body) {
    const auto expression = wire::decode_face_expression(body);
    if (!expression || !session_.joined())
        return;
    const std::lock_guard lock(shared_->mutex);
    if (expression->state == wire::FaceExpression::State::none)
        shared_->expressions.erase(person);
    else if (shared_->expressions.size() < max_poses || shared_->expressions.contains(person))
        shared_->expressions[person] = *expression;
}

std::map<ParticipantId, wire::FaceExpression> Participant::expressions() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->expressions;
}

}  // namespace theatron::client
