// SPDX-License-Identifier: Apache-2.0
// A speaker's side: makes packets of the samples of a microphone. Not in the web build.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "voice/opus_codec.h"
#include "voice/packet.h"

namespace theatron::voice {

// Not thread safe.
class Talker {
public:
    // `send` gets each packet; it is valid during the call. `frame_ms`: 10 or 20.
    Talker(int frame_ms, std::function<void(ByteView packet)> send);

    // Samples of the microphone, in order, -1 to 1; `end` is the session time behind the last one.
    void take(std::span<const float> samples, TimePoint end);

    // A closed microphone sends nothing; its frames are counted on.
    void set_open(bool open) { is_open_ = open; }
    bool is_open() const { return is_open_; }
    // Level of the last frame, -127 to 0, open or closed.
    int level_db() const { return level_db_; }

private:
    void send_frame(std::span<const float> frame, TimePoint time);

    int frame_ms_;
    Encoder encoder_;
    std::function<void(ByteView)> send_;
    std::vector<float> waiting_;
    Bytes opus_, packet_;
    std::uint32_t number_ = 0;
    bool is_open_ = true;
    bool is_speaking_ = false;  // no packet with `pauses` was sent since the last one without
    int level_db_ = -127;
};

}  // namespace theatron::voice
