// SPDX-License-Identifier: Apache-2.0
#include "sound/voice_input.h"

#include <utility>

#include "voice/packet.h"

namespace theatron::sound {

VoiceInput::VoiceInput(int frame_ms, std::function<void(ByteView)> send,
                       std::function<TimePoint(TimePoint)> session_time)
    : session_time_(std::move(session_time)), talker_(frame_ms, std::move(send)) {}

void VoiceInput::work() {
    feed_.drain([this](std::span<const float> samples, TimePoint end) {
        if (EchoCanceller* const canceller = canceller_) {
            samples = cleaned(samples, *canceller);
            end -= Duration(std::int64_t(uncleaned_.size()) * 1'000'000 / voice::sample_rate);
        }
        const TimePoint session_end = session_time_(end);
        const std::lock_guard lock(mutex_);
        talker_.take(samples, session_end);
    });
}

// The whole blocks of the samples so far; the rest waits for the next ones.
std::span<const float> VoiceInput::cleaned(std::span<const float> samples,
                                           EchoCanceller& canceller) {
    constexpr std::size_t block = EchoCanceller::block;
    uncleaned_.insert(uncleaned_.end(), samples.begin(), samples.end());
    const std::size_t whole = uncleaned_.size() / block * block;
    for (std::size_t i = 0; i < whole; i += block)
        canceller.clean(std::span<float, block>(uncleaned_.data() + i, block));
    const auto end = uncleaned_.begin() + std::ptrdiff_t(whole);
    cleaned_.assign(uncleaned_.begin(), end);
    uncleaned_.erase(uncleaned_.begin(), end);
    return cleaned_;
}

void VoiceInput::set_open(bool open) {
    const std::lock_guard lock(mutex_);
    talker_.set_open(open);
}

bool VoiceInput::is_open() const {
    const std::lock_guard lock(mutex_);
    return talker_.is_open();
}

int VoiceInput::level_db() const {
    const std::lock_guard lock(mutex_);
    return talker_.level_db();
}

}  // namespace theatron::sound
