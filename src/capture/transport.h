// SPDX-License-Identifier: Apache-2.0
// The common clock of the cameras of one recording and of its room: where the recording is, and
// whether it is paused. All functions: any thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "base/time.h"

namespace theatron::capture {

class Transport {
public:
    // `length` is that of the recording; `round` the duration of one round of a loop, empty:
    // played once. It begins at `begin` with the first call of state().
    Transport(Duration length, std::optional<Duration> round, Duration begin);

    struct State {
        Duration position{};  // since the recording's first picture, now; not behind its end
        bool paused = false;
        bool at_end = false;        // of a recording that is played once
        std::uint64_t changes = 0;  // by the functions below
        std::uint64_t rounds = 0;   // of a loop that are over
    };
    State state(TimePoint now);
    Duration length() const { return length_; }

    void pause(TimePoint now);
    // At the end it begins again.
    void resume(TimePoint now);
    // Goes on from there, or stays paused.
    void seek(Duration position, TimePoint now);

private:
    State state_at(TimePoint now);

    const Duration length_;
    const std::optional<Duration> round_;
    std::mutex mutex_;  // guards all below
    bool begun_ = false, paused_ = false;
    Duration position_;  // at `at_`
    TimePoint at_;
    std::uint64_t changes_ = 0, rounds_ = 0;
};

}  // namespace theatron::capture
