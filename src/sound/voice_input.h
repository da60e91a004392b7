// SPDX-License-Identifier: Apache-2.0
// A person's own voice, from a microphone to packets: echo and noise taken out, silence left out,
// Opus.
//
// Reads no clock and has no thread. The device's thread uses take(), a FeedThread work(), any
// others the rest. Only these others and work() share a lock.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/time.h"
#include "sound/echo_canceller.h"
#include "voice/microphone_feed.h"
#include "voice/talker.h"

namespace theatron::sound {

class VoiceInput {
public:
    // `frame_ms`: 10 or 20. `send` gets each packet, `session_time` turns the steady clock's time
    // into the session's; both from work().
    VoiceInput(int frame_ms, std::function<void(ByteView packet)> send,
               std::function<TimePoint(TimePoint steady)> session_time);

    // The device has delivered these samples; `end` is the steady clock's time behind the last one.
    // See MicrophoneFeed::take().
    void take(std::span<const float> samples, TimePoint end) noexcept { feed_.take(samples, end); }
    // To be called after each take().
    void work();

    // Null: the samples are sent as they come. It must outlive this object.
    void clean_by(EchoCanceller* canceller) { canceller_ = canceller; }
    // As voice::Talker has them.
    void set_open(bool open);
    bool is_open() const;
    int level_db() const;
    // Samples of the microphone that were not sent, because work() was called too late.
    std::uint64_t lost() const { return feed_.lost(); }

private:
    std::span<const float> cleaned(std::span<const float> samples, EchoCanceller& canceller);

    voice::MicrophoneFeed feed_;
    const std::function<TimePoint(TimePoint)> session_time_;
    std::atomic<EchoCanceller*> canceller_ = nullptr;
    std::vector<float> uncleaned_, cleaned_;  // of work()
    mutable std::mutex mutex_;
    voice::Talker talker_;  // under mutex_
};

}  // namespace theatron::sound
