// SPDX-License-Identifier: Apache-2.0
// A joined session: its cameras, and a reader of their newest frames. Thread safe; no function
// needs Python's lock.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client/participant.h"
#include "frame_reader.h"

namespace theatron::python {

class JoinedSession {
public:
    struct Options {
        std::string link, name, depth_codec, color_codec;
    };
    // Begins to connect. Throws Error if the link or a codec is wrong.
    explicit JoinedSession(const Options& options);

    // Waits at most a tenth of a second. True once it has joined. Throws Error if it is refused.
    bool is_joined();
    // An operator must let it in, which may take long.
    bool is_at_door() const {
        return participant_.status().phase == client::Participant::Phase::waiting;
    }
    // Why it is not joined, as far as it is known; one sentence or empty.
    std::string problem() const { return participant_.status().problem; }

    std::string host_name() const { return participant_.status().host_name; }
    std::vector<std::shared_ptr<const CameraView>> cameras();

    // As FrameReader: the newest frame of each camera that has a new one; those in between are left
    // out where the caller is slower. The end of the session is the end; a lost connection is
    // tried again.
    FrameReader::Answer next(TakenFrame& out);

private:
    void note_cameras();
    TakenFrame taken(const receive::CameraFrame& frame);

    client::Participant participant_;

    std::mutex mutex_;  // guards all below
    std::uint64_t generation_ = 0;
    std::map<CameraId, std::shared_ptr<const CameraView>> views_;
    std::deque<receive::CameraFramePtr> waiting_;
    std::optional<TimePoint> first_;
    FramePool pool_;
};

// The frames of a session, until nobody has it any more.
std::unique_ptr<FrameReader> read_session(std::weak_ptr<JoinedSession> session);

}  // namespace theatron::python
