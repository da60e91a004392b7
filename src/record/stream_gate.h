// SPDX-License-Identifier: Apache-2.0
// Which frames of a live stream a recording takes, without decoding any: from a
// fresh key frame on, those whose reference has been recorded too.
//
// A host first sends who joins the last key frame and what followed it, which
// may be minutes old; a recording is to begin now.
#pragma once

#include <deque>
#include <optional>

#include "base/time.h"
#include "wire/media_header.h"

namespace theatron::record {

class StreamGate {
public:
    // `now` as in media headers: session time.
    explicit StreamGate(TimePoint now) : opened_(now) {}

    struct Answer {
        bool record = false;
        bool ask_for_key = false;  // the host should send a key frame
    };
    Answer on_frame(const wire::MediaHeader& header, TimePoint now);

private:
    bool ask(TimePoint now);

    TimePoint opened_;
    bool begun_ = false;
    std::deque<FrameNumber> recorded_;  // the last ones
    std::optional<TimePoint> asked_;
};

}  // namespace theatron::record
