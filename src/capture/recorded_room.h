// SPDX-License-Identifier: Apache-2.0
// The room of a recorded session at each of its moments: people, objects and poses
// (docs/formats/room.md).
#pragma once

#include <memory>
#include <optional>

#include "record/recording_file.h"
#include "session/room_track.h"

namespace theatron::capture {

// Safe for untrusted files: damaged parts are left out up to the next snapshot, and counted. One
// thread at a time.
class RecordedRoom {
public:
    explicit RecordedRoom(std::shared_ptr<const record::RecordingFile> recording)
        : recording_(std::move(recording)) {}

    // Moves on to `time` since the recording's first picture, or back to it; before the first
    // snapshot, the room is as there. True if it may have changed.
    bool go_to(Duration time);
    // The time of the next change; empty if none follows.
    std::optional<Duration> next();

    const session::RoomObjects& objects() const { return reader_.objects(); }
    const session::PoseBodies& poses() const { return reader_.poses(); }

    // Since the construction.
    struct Figures {
        std::uint64_t parts = 0, bytes = 0;  // read
        std::uint64_t changes = 0;           // entries that were applied
        std::uint64_t damaged = 0;           // parts
        std::uint64_t undecodable = 0;       // parts that refer to damaged or missing ones
    };
    const Figures& figures() const { return figures_; }

private:
    void rewind();
    void skip_to_snapshot_before(Duration time);
    bool begin_part();

    std::shared_ptr<const record::RecordingFile> recording_;
    session::RoomTrackReader reader_;
    std::size_t next_part_ = 0;
    FrameNumber number_ = 0;   // of the newest part
    std::size_t segment_ = 0;  // the same
    Duration time_{};          // that the room is at
    Bytes payload_;
    Figures figures_;
};

}  // namespace theatron::capture
