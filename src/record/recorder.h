// SPDX-License-Identifier: Apache-2.0
// Records encoded streams in the order of arrival, without ever blocking them.
//
// Any thread may add messages. A thread of the recorder writes them ten times a
// second, and waits about once a second until the disk has them. A problem such
// as a full disk ends the recording and nothing else.
#pragma once

#include <condition_variable>
#include <deque>
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
#include "record/lacks.h"
#include "record/recorded_camera.h"
#include "record/segment_info.h"
#include "record/segment_writer.h"
#include "wire/media_header.h"

namespace theatron::record {

class Recorder {
public:
    struct Options {
        // Memory for messages that are not on the disk yet, those being written included. It limits
        // the time for which a disk may stall.
        std::size_t buffer_bytes = std::size_t(1) << 30;
        // Replaces an existing file and the later segments of its recording; false: refuses it.
        bool replace = true;
        // Messages of room_stream (recording_layout.h) are recorded as well.
        bool has_room = false;
    };

    enum class Added {
        taken,
        dropped,       // the buffer is full: the disk is too slow
        ended,         // finish() was called, or the recording has ended by itself
        not_recorded,  // of a stream that the current segment does not have
    };

    struct Figures {
        Duration duration{};  // of the segments (SegmentWriter::duration()), together
        std::uint64_t bytes = 0;
        std::uint64_t frames = 0;       // pictures written, depth and colour counted each
        std::uint64_t room_bytes = 0;   // of messages of the room, written
        std::uint64_t voice_bytes = 0;  // of messages of voices, written, silence included
        std::map<StreamId, std::uint64_t> frames_of;   // pictures by stream; absent: none
        std::uint64_t dropped = 0;                     // came faster than the disk could write
        std::map<StreamId, std::uint64_t> dropped_of;  // the same by stream; absent: none
        std::size_t waiting_bytes = 0;                 // of messages that are not written yet
        Duration late{};                               // waiting time of the oldest of them
        std::uint64_t cut_bytes = 0;                   // that another program cut off its files
        std::uint32_t segments = 1;
        // There is no name for a further file: the last one goes on, without what it has no track
        // for, which counts as dropped.
        bool is_in_last_file = false;
        std::string problem;  // one sentence if it has ended by itself; else empty
    };

    // Creates the first segment's file, in place of an existing one. Later segments get names of
    // their own beside it (segment_path), never that of an existing file. At most 63 cameras and
    // max_voice_tracks voices. Throws Error.
    Recorder(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras,
             const ClockPair& clock, const Options& options,
             const std::vector<VoiceTrack>& voices = {});
    Recorder(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras,
             const ClockPair& clock)
        : Recorder(path, cameras, clock, Options{}) {}
    // Calls finish().
    ~Recorder();

    // Messages that are added from now on belong to a new segment: cameras, settings or
    // calibrations have changed, or the session's clock has restarted. Never waits. The file is
    // made when the segment's first message is written, and its folder if that was deleted. After
    // max_segments files the last one goes on with the streams that it has. From any thread, in
    // order with add().
    void begin_segment(const std::vector<RecordedCamera>& cameras, const ClockPair& clock,
                       const std::vector<VoiceTrack>& voices = {});

    // Takes a whole media message of one of the streams of cameras and voices, or of the room,
    // which arrived at session time `now`. Never waits. From any thread. `filters`: see
    // RecordedMessage. A message that was not taken leaves a gap: the stream's next one must be a
    // key frame, because references to the missing one cannot be decoded.
    [[nodiscard]] Added add(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                            TimePoint now, const std::string& filters = {});

    // From any thread.
    Figures figures() const;
    // Those of its segments, in order; the last one is being written.
    std::vector<std::filesystem::path> files() const;

    // Writes all added messages and closes the file. Further messages are refused.
    void finish();
    // After finish(): notes in the last file what the recording lacks, besides what Figures says of
    // an end by itself.
    void note_lacks(const Lacks& lacks);

private:
    // A message, or the beginning of a segment.
    struct Waiting {
        RecordedMessage message;
        Duration came;  // on the recorder's own scale
        std::shared_ptr<const SegmentWriter::Content> segment;
        ClockPair clock;
    };

    Duration own_time(TimePoint now);
    void run();
    bool take(std::deque<Waiting>& batch);
    std::string write(std::deque<Waiting>& batch);
    std::string write_messages(std::vector<RecordedMessage>& messages);
    std::string begin_next();
    std::optional<std::filesystem::path> next_path();
    void go_on_without(const SegmentWriter::Content& content);
    void leave_out(std::vector<RecordedMessage>& messages);

    const std::filesystem::path path_;
    const std::size_t buffer_bytes_;
    const bool has_room_;
    // The writing thread's only.
    SegmentInfo info_;
    std::uint32_t file_number_ = 1;  // of the newest file's name
    std::unique_ptr<SegmentWriter> writer_;
    SegmentWriter::Content content_;       // of its file
    std::vector<StreamId> without_track_;  // in it, since no further file can be made
    std::optional<Waiting> next_;          // the segment that begins with the next message
    Duration duration_before_{};           // of the segments before this one
    std::uint64_t bytes_before_ = 0, cut_before_ = 0;

    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::vector<StreamId> streams_;  // of the newest segment
    std::deque<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;  // those being written included
    std::size_t unseen_bytes_ = 0;   // those being written left out
    TimePoint last_now_;
    Duration own_now_{};
    std::optional<Duration> oldest_;  // arrival of the oldest message that is being written
    bool finishing_ = false;
    Figures figures_;
    std::vector<std::filesystem::path> files_;

    std::thread thread_;
};

}  // namespace theatron::record
