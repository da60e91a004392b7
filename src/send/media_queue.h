// SPDX-License-Identifier: Apache-2.0
// Encoded frames on their way from the lanes to the thread that sends them. Should that thread
// be held up, the newest wins, or while somebody records all are kept for longer; the queue stays
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
    // Frames of one stream in one setting that wait. At one more, those that wait are dropped,
    // and the stream goes on with a key frame.
    static constexpr std::size_t max_waiting = 4;
    // The same while somebody records: three seconds at 30 frames per second; of all streams
    // together at most so many bytes.
    static constexpr std::size_t max_kept = 90;
    static constexpr std::size_t max_kept_bytes = std::size_t(128) << 20;

    // From any thread. Somebody records, or nobody does any more.
    void keep_everything(bool keep);

    // From any thread. True if nothing waited: somebody should be told to take.
    [[nodiscard]] bool put(EncodedMedia media);

    struct Taken {
        std::vector<EncodedMedia> media;  // in the order of each stream
        // How many frames of a stream were dropped since the last time, because nobody took them.
        std::map<StreamId, std::uint64_t> dropped;
        // Nothing more of these comes before a key frame.
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
