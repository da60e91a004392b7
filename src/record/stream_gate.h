// SPDX-License-Identifier: Apache-2.0
// Which frames of a live stream a recording takes, without decoding any: from a
// key frame on, those whose reference has been recorded too. Counts what is
// missing, and says when to ask for a key frame.
//
// Pure: times are the recorder's own clock at arrival, so that the session's
// clock, which may be anything, is never compared with it.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/time.h"
#include "wire/media_header.h"

namespace theatron::record {

class StreamGate {
public:
    // A stream with references is asked for a key frame this often. One frame, a request's way
    // and the host's tick later it is there: in less than two seconds.
    static constexpr Duration key_period = std::chrono::milliseconds(1500);
    // A key frame that does not come is asked for again.
    static constexpr Duration key_patience = std::chrono::milliseconds(700);

    // `phase`, from zero to key_period, is when in each period the key frame is asked for: that
    // of several streams should not be the same.
    explicit StreamGate(Duration phase = {}) : phase_(phase) {}

    struct Answer {
        bool record = false;
        bool ask_for_key = false;
    };
    Answer on_frame(const wire::MediaHeader& header, TimePoint now);

    // The frame that was to be recorded just now could not be: what follows waits for a key frame.
    // True if that should be asked for.
    bool on_dropped(TimePoint now);
    // What follows waits for a key frame: a segment or a connection begins.
    void close();

    // The next frame that refers to another asks for a key frame, although nothing is missing.
    void want_key() { wants_key_ = true; }
    // Some frames of the stream refer to others.
    bool has_references() const { return has_references_; }

    struct Figures {
        std::uint64_t recorded = 0;
        // Frames that never came, or without what they refer to. Those before the first key
        // frame belong to no recording.
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
