// SPDX-License-Identifier: Apache-2.0
// The last minute of a session's cameras, as they were encoded. Bounded in time and bytes: the
// oldest pictures are forgotten. Nothing of it is ever written to a file.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "wire/media_header.h"

namespace theatron::session {

// The bytes of all pictures that are kept.
inline constexpr std::size_t max_past_bytes = std::size_t(512) << 20;

struct PastBounds {
    Duration reach{};  // how far participants may look back; 0: nothing is kept
    std::size_t bytes = max_past_bytes;
};

class Past {
public:
    // The longest reach.
    static constexpr Duration longest_reach = std::chrono::seconds(60);
    // A stream with references has a key frame at least as often.
    static constexpr Duration key_every = std::chrono::seconds(2);
    // Kept for longer than the reach, since playing begins at an earlier key frame.
    static constexpr Duration margin = 3 * key_every;

    explicit Past(const PastBounds& bounds) : bounds_(bounds) {}

    Duration reach() const { return bounds_.reach; }
    std::size_t bytes() const { return bytes_; }

    struct Picture {
        TimePoint at;  // when it was kept, in session time
        wire::MediaHeader header;
        std::string codec;                     // of its setting
        std::shared_ptr<const Bytes> message;  // header and payload; null: it was forgotten
    };
    // Counts all pictures ever kept.
    using Position = std::uint64_t;

    // Keeps a copy of a media message. `now` must not be earlier than in the call before. True if
    // its stream should make a key frame.
    [[nodiscard]] bool add(const wire::MediaHeader& header, ByteView message,
                           const std::string& codec, TimePoint now);
    // Forgets what is older than the bounds allow.
    void on_time(TimePoint now);
    // Forgets the pictures of a camera. Those that were captured before `now` are not kept any
    // more, either.
    void forget(CameraId camera, TimePoint now);
    void clear();

    // The positions of the oldest picture and behind the newest one.
    Position begin() const { return first_; }
    Position end() const { return first_ + pictures_.size(); }
    // Null if there is none at this position, or no longer.
    const Picture* find(Position position) const;
    // The position to play from, in order to see what was kept at this time: that of a key frame,
    // up to key_every earlier, or of the oldest key frame there is. Empty: there is none.
    std::optional<Position> start(TimePoint at) const;

private:
    void drop_oldest();

    const PastBounds bounds_;
    std::deque<Picture> pictures_;  // by `at`
    Position first_ = 0;
    std::size_t bytes_ = 0;
    std::map<StreamId, TimePoint> newest_key_;
    std::map<CameraId, TimePoint> not_before_;
};

}  // namespace theatron::session
