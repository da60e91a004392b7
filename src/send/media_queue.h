// SPDX-License-Identifier: Apache-2.0
// Encoded frames between the lanes and the thread that sends them. If that thread is delayed, the
// newest frame wins; while a participant records, all frames are kept for longer. The queue is
// bounded in both cases.
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "send/lane_encoders.h"

namespace theatron::send {

class MediaQueue {
public:
    // Frames of one stream in one setting that may wait. One more drops all that wait, and the
    // stream continues with a key frame.
    static constexpr std::size_t max_waiting = 4;
    // The same while a participant records: three seconds at 30 frames per second. All streams
    // together may wait with at most `max_kept_bytes`.
    static constexpr std::size_t max_kept = 90;
    static constexpr std::size_t max_kept_bytes = std::size_t(128) << 20;

    // From any thread. True while at least one participant records.
    void keep_everything(bool keep);

    // From any thread. True for the first frame since take(): the taker must then be woken.
    [[nodiscard]] bool put(EncodedMedia media);

    struct Taken {
        std::vector<EncodedMedia> media;  // in the order of each stream
        // Frames of a stream that were dropped since the last call because take() came too late.
        std::map<StreamId, std::uint64_t> dropped;
        // Nothing of these is sent before a key frame.
        std::vector<std::pair<StreamId, SettingId>> broken;
    };
    Taken take();  // everything

private:
    struct Lane {
        std::deque<EncodedMedia> waiting;
        bool broken = false;
        std::uint64_t dropped = 0;
    };

    bool is_full(const Lane& lane) const;
    void drop_waiting(Lane& lane);

    std::mutex mutex_;  // guards all below
    std::map<std::pair<StreamId, SettingId>, Lane> lanes_;
    std::size_t bytes_ = 0;  // of all that waits
    bool keep_everything_ = false;
    bool told_ = false;
};

}  // namespace theatron::send
