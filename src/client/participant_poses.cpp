// SPDX-License-Identifier: Apache-2.0
// The poses of a participant and of the others.
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

}  // namespace theatron::client
