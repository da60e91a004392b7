// SPDX-License-Identifier: Apache-2.0
#include "capture/transport.h"

#include <algorithm>

namespace theatron::capture {

Transport::Transport(Duration length, std::optional<Duration> round, Duration begin)
    : length_(length), round_(round), position_(begin) {}

Transport::State Transport::state(TimePoint now) {
    const std::lock_guard lock(mutex_);
    return state_at(now);
}

// The mutex is held.
Transport::State Transport::state_at(TimePoint now) {
    if (!begun_) {
        begun_ = true;
        at_ = now;
    }
    if (!paused_ && now > at_) {
        position_ += now - at_;
        at_ = now;
        while (round_ && position_ >= *round_) {
            position_ -= *round_;
            ++rounds_;
        }
    }
    // In the last moment of a round there is no other picture than the last one.
    const bool at_end = !round_ && position_ >= length_;
    if (at_end)
        position_ = length_;
    return {std::min(position_, length_), paused_, at_end, changes_, rounds_};
}

void Transport::pause(TimePoint now) {
    const std::lock_guard lock(mutex_);
    (void)state_at(now);
    paused_ = true;
    ++changes_;
}

void Transport::resume(TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (state_at(now).at_end)
        position_ = {};
    paused_ = false;
    at_ = now;
    ++changes_;
}

void Transport::seek(Duration position, TimePoint now) {
    const std::lock_guard lock(mutex_);
    (void)state_at(now);
    position_ = std::clamp(position, Duration(0), length_);
    at_ = now;
    ++changes_;
}

}  // namespace theatron::capture
