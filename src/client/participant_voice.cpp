// SPDX-License-Identifier: Apache-2.0
// The voice of a participant.
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

}  // namespace theatron::client
