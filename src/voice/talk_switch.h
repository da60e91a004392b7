// SPDX-License-Identifier: Apache-2.0
// A person's microphone is open by its switch and, with push to talk, while a key is held.
//
// Pure; time is passed in. Not thread safe.
#pragma once

#include "base/time.h"

namespace theatron::voice {

class TalkSwitch {
public:
    // The microphone stays open for this time behind the release of the key, so that the end of a
    // word is heard.
    static constexpr Duration release_time = std::chrono::milliseconds(200);

    explicit TalkSwitch(bool pushes) : pushes_(pushes) {}

    void set_open(bool open) { is_open_ = open; }
    bool is_open() const { return is_open_; }
    // With push to talk.
    void set_pushes(bool pushes) { pushes_ = pushes; }
    bool pushes() const { return pushes_; }

    // The key is held at this time, or not. Call it a few times a second.
    void hold(bool is_held, TimePoint now) {
        if (is_held)
            held_at_ = now;
        key_talks_ = is_held || (key_talks_ && now - held_at_ < release_time);
    }

    // The person's voice is to be sent.
    bool talks() const { return is_open_ && (!pushes_ || key_talks_); }

private:
    bool is_open_ = true;
    bool pushes_;
    bool key_talks_ = false;  // the key is held, or was until just now
    TimePoint held_at_;
};

}  // namespace theatron::voice
