// SPDX-License-Identifier: Apache-2.0
// The voice of a participant.
#include <algorithm>
#include <utility>

#include "client/participant_shared.h"

namespace theatron::client {
namespace {

constexpr std::size_t max_unsent_voice = 8;

}  // namespace

void Participant::send_voice(ByteView packet) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || packet.empty() || packet.size() > wire::max_voice_size)
        return;
    if (shared_->voice.size() >= max_unsent_voice)
        shared_->voice.pop_front();
    const bool is_telling = !shared_->voice.empty();
    shared_->voice.emplace_back(packet.begin(), packet.end());
    if (!is_telling)
        shared_->client->post([this] { tell_voice(); });
}

void Participant::tell_voice() {
    std::deque<Bytes> packets;
    {
        const std::lock_guard lock(shared_->mutex);
        packets.swap(shared_->voice);
    }
    if (!session_.joined())
        return;
    for (const Bytes& packet : packets)
        shared_->client->send_voice({session_.welcome().participant, packet});
}

void Participant::allow_voice_recording(bool agrees) {
    const std::lock_guard lock(shared_->mutex);
    if (std::exchange(shared_->voice_may_record, agrees) != agrees && shared_->client)
        shared_->client->post([this] { tell_voice_consent(); });
}

bool Participant::voice_may_record() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->voice_may_record;
}

bool Participant::asks_voice_consent() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->asks_voice_consent;
}

void Participant::tell_voice_consent() {
    if (!session_.joined())
        return;
    const auto& features = session_.welcome().features;
    const bool is_asked =
        std::count(features.begin(), features.end(), wire::Feature::voice_consent) > 0;
    bool agrees = false;
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->asks_voice_consent = is_asked;
        agrees = shared_->voice_may_record;
    }
    if (is_asked)
        shared_->client->send_control(wire::encode(wire::VoiceConsent{agrees}));
}

}  // namespace theatron::client
