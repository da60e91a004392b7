// SPDX-License-Identifier: Apache-2.0
// Chooses the frames of a live stream that a recording takes, without decoding any:
// after a key frame, those whose reference has been recorded too. Counts missing
// frames, and decides when to request a key frame.
//
// Pure: times are the recorder's own clock at arrival, so that the session's
// clock, which may have any value, is never compared with it.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/time.h"
#include "wire/media_header.h"

namespace theatron::record {

class StreamGate {
public:
    // Time between requests for key frames of a stream with references. The key frame arrives one
    // frame, a request's travel time and the host's tick later: in less than two seconds.
    static constexpr Duration key_period = std::chrono::milliseconds(1500);
    // A key frame that does not come is requested again after this time.
    static constexpr Duration key_patience = std::chrono::milliseconds(700);

    // `phase`, from zero to key_period, is when in each period the key frame is asked for: that
    // of several streams should not be the same.
    explicit StreamGate(Duration phase = {}) : phase_(phase) {}

    struct Answer {
        bool record = false;
        bool ask_for_key = false;
    };
    Answer on_frame(const wire::MediaHeader& header, TimePoint now);

    // The frame that on_frame() accepted last was dropped: recording continues with a key frame.
    // True if one should be requested now.
    bool on_dropped(TimePoint now);
    // Recording continues with a key frame: a segment or a connection begins.
    void close();
    // Another stream goes on in place of this one, which has ended.
    void restart();

    // The next frame that refers to another asks for a key frame, although nothing is missing.
    void want_key() { wants_key_ = true; }
    // The next frame is recorded although it refers to another.
    bool is_open() const { return open_; }
    // Some frames of the stream refer to others.
    bool has_references() const { return has_references_; }

    struct Figures {
        std::uint64_t recorded = 0;
        // Frames that never came, or came without their reference. Frames before the first key
        // frame do not count.
        std::uint64_t lost = 0;
        std::uint64_t dropped = 0;  // given to on_dropped()
    };
    const Figures& figures() const { return figures_; }

private:
    bool ask(TimePoint now);
    bool has_recorded(FrameNumber frame) const;

    Duration phase_;
    bool begun_ = false, open_ = false;
    bool wants_key_ = false, has_references_ = false;
    std::deque<FrameNumber> recorded_;  // the last ones
    std::optional<FrameNumber> newest_;
    std::optional<TimePoint> asked_;
    std::optional<TimePoint> next_key_;
    Figures figures_;
};

}  // namespace theatron::record
