// SPDX-License-Identifier: Apache-2.0
// The room's objects and the adjustments of cameras in a file of the host's state folder
// (docs/formats/room.md), so that a restart keeps them. An own thread writes, so that a slow disk
// delays no participant.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "base/time.h"
#include "base/utc.h"
#include "session/host_room.h"
#include "session/kept_adjustments.h"

namespace theatron::host {

struct SavedRoom {
    session::ObjectsSnapshot room;
    session::HostRoom::Authors authors;
    // When it was saved; times of its objects are session time of that run. 0: unknown.
    TimePoint session_time;
    UtcTime utc;
    std::vector<session::KeptAdjustment> adjustments;  // of cameras
};
Bytes encode_room(const SavedRoom& saved);
// Safe for untrusted input. Status::malformed for damaged bytes and for a wrong checksum,
// Status::unsupported for the file of a newer version.
Result<SavedRoom> decode_room(ByteView bytes);

class RoomFile {
public:
    // Shortest time between two writes of the file.
    static constexpr Duration interval = std::chrono::seconds(1);

    // Starts the thread.
    explicit RoomFile(std::filesystem::path path);
    // Writes a room that still waits.
    ~RoomFile();

    // The saved content; nothing without a file. A file that cannot be used is logged and kept
    // as `room.damaged`, `room.damaged.2` and so on. Throws Error if the file cannot be read.
    SavedRoom load();

    // Why the newest room could not be written; empty if it could. A later one is tried again, and
    // the last one when this object ends, which waits for that.
    std::string problem() const;
    // Waits until nothing waits to be written, and ends the thread.
    void close();

    using Adjustments = std::vector<session::KeptAdjustment>;
    // From one thread, several times a second: writes the room if it has changed.
    void on_tick(const session::HostRoom& room, const Adjustments& adjustments, TimePoint now);
    // The same at once.
    void save(const session::HostRoom& room, const Adjustments& adjustments, TimePoint now);

private:
    void run();

    const std::filesystem::path path_;
    std::uint64_t saved_version_ = 0;
    Adjustments saved_adjustments_;
    TimePoint saved_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Bytes> waiting_;  // guarded by mutex_, as is stopping_
    bool stopping_ = false;
    std::string problem_;  // guarded by mutex_
    std::thread thread_;
};

}  // namespace theatron::host
