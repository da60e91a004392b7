// SPDX-License-Identifier: Apache-2.0
// What to send next to one peer, and what to drop: the sending policy, apart
// from any socket.
//
// Control goes first, always whole. Media waits in short queues, one per
// stream, and the newest frame wins: a frame that any receiver can do without
// is dropped as soon as a newer one comes; a broken chain of references is cut
// at once and taken up again at the next key frame. So a slow peer gets fewer
// frames, never older ones, and memory is bounded.
#pragma once

#include <deque>
#include <map>
#include <memory>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"

namespace theatron::net {

// One media message, shared by all peers that get it. The bytes begin with a
// wire::MediaHeader; the fields that the policy needs are repeated here.
struct Media {
    std::shared_ptr<const Bytes> bytes;
    StreamId stream{};
    SettingId setting{};
    FrameNumber frame = 0;
    FrameNumber reference = 0;
    int temporal_layer = 0;
    bool key = false;
};

// Not thread safe.
class Outbox {
public:
    // Frames of one stream that may wait behind the one being sent.
    static constexpr std::size_t max_waiting = 2;
    // More control than this waiting means that the peer reads nothing.
    static constexpr std::size_t max_control_bytes = std::size_t(1) << 20;

    // Queues a control envelope (wire::wrap_control). False if the peer should
    // be given up.
    [[nodiscard]] bool push_control(Bytes envelope);

    struct Pushed {
        int dropped = 0;         // frames given up, this one included if need be
        bool needs_key = false;  // nothing of this stream goes out before a key frame
    };
    Pushed push_media(Media media);

    // Fills `envelope` with what to send next; false if there is nothing. `now`
    // is the session time that is written into a media message as `sent`.
    bool next(Bytes& envelope, TimePoint now);

    bool empty() const { return control_.empty() && !sending_ && waiting_ == 0; }
    std::size_t waiting_frames() const { return waiting_ + (sending_ ? 1 : 0); }

private:
    struct Lane {
        std::deque<Media> waiting;
        SettingId setting{};
        bool broken = true;  // nothing may be sent but a key frame
        std::uint64_t turn = 0;
    };

    int drop_waiting(Lane& lane);

    std::deque<Bytes> control_;
    std::size_t control_bytes_ = 0;
    std::map<StreamId, Lane> lanes_;
    std::size_t waiting_ = 0;
    std::uint64_t turn_ = 0;
    std::shared_ptr<const Bytes> sending_;
    std::size_t sent_ = 0;  // bytes of sending_ that are out
};

}  // namespace theatron::net
