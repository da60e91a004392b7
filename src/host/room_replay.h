// SPDX-License-Identifier: Apache-2.0
// Replays the room of a recording whose cameras a host plays: at each moment tells what has
// changed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "capture/recorded_room.h"

namespace theatron::host {

// The recording of a host's camera, if its room was recorded.
struct ReplayedRoom {
    std::shared_ptr<const record::RecordingFile> recording;
    std::string file;               // as the camera's specification names it
    std::size_t camera = 0;         // the first of the host's cameras that plays it
    Duration begin{};               // of the recording, at the camera's first picture
    std::optional<Duration> round;  // of a loop; else the recording is played once
};
// The room of the first of these camera specifications that plays a recording with one; empty if
// there is none. Throws Error for a file that cannot be read.
std::optional<ReplayedRoom> find_replayed_room(const std::vector<std::string>& specifications);
// True for a camera of the same recording.
bool plays(const ReplayedRoom& room, const std::string& specification);

class RoomReplay {
public:
    // Shortest time between two calls of `show`: a period of poses (session/pose_board.h).
    static constexpr Duration period = Duration(11'111);

    struct Change {
        session::RoomObjects objects;  // all, with recorded numbers
        // Poses that are new, with recorded numbers and the present time; and people without one.
        std::vector<std::pair<ParticipantId, Bytes>> poses;
        std::vector<ParticipantId> left;
    };

    // Begins when `has_begun` is true for the first time. Calls both functions from its own thread.
    RoomReplay(ReplayedRoom room, std::function<bool()> has_begun,
               std::function<void(Change)> show);
    ~RoomReplay();

private:
    void run();
    Change change(TimePoint now);

    const ReplayedRoom source_;
    const std::function<bool()> has_begun_;
    const std::function<void(Change)> show_;
    capture::RecordedRoom room_;
    session::PoseBodies shown_;
    std::atomic<bool> stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host
