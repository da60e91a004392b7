// SPDX-License-Identifier: Apache-2.0
// Records encoded streams as they come, without ever holding them up.
//
// Messages are handed over from any thread and written by a thread of the
// recorder's own, ten times a second, so that a crash loses a fraction of a
// second. Trouble, as with a full disk, ends the recording and nothing else.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "record/matroska_writer.h"
#include "wire/media_header.h"

namespace theatron::record {

struct RecordedStream {
    std::string codec;  // its setting in full: "zstd:delta=1", "jpeg:quality=85"
    int width = 0, height = 0;
    bool operator==(const RecordedStream&) const = default;
};

struct RecordedCamera {
    CameraId id{};
    std::string name;
    double frames_per_second = 0;
    Bytes calibration;  // as geometry/calibration.h writes it
    RecordedStream depth;
    std::optional<RecordedStream> color;
    bool operator==(const RecordedCamera&) const = default;
};

class Recorder {
public:
    struct Figures {
        Duration duration{};  // from the first frame's exposure to the last one's
        std::uint64_t bytes = 0;
        std::uint64_t frames = 0;   // written, depth and colour counted each
        std::uint64_t dropped = 0;  // came faster than the disk could write
        std::string problem;        // why it has ended by itself, one sentence; empty if it has not
    };

    // Creates the file, in place of one that is there. At most 63 cameras.
    // Throws Error.
    Recorder(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras);
    // Finishes.
    ~Recorder();

    // Takes a whole media message of one of the cameras' streams. Never waits; returns false if it
    // was dropped, because the disk is too slow or the recording has ended. From any thread.
    // `filters` names those that the depth went through (docs/filters.md); empty: none.
    bool add(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
             const std::string& filters = {});

    // From any thread.
    Figures figures() const;

    // Writes all that was added, and closes the file. Further messages are dropped.
    void finish();

private:
    struct Waiting {
        wire::MediaHeader header;
        std::shared_ptr<const Bytes> message;
        std::string filters;
    };

    void run();
    std::string write(std::vector<Waiting>& batch);

    MatroskaWriter writer_;
    std::vector<StreamId> streams_;
    // The writing thread's only.
    std::optional<TimePoint> begin_;
    std::map<std::pair<StreamId, FrameNumber>, std::int64_t> recent_us_;
    std::map<StreamId, std::string> filters_;  // of each stream's last frame

    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::vector<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;
    bool finishing_ = false;
    Figures figures_;

    std::thread thread_;
};

}  // namespace theatron::record
