// SPDX-License-Identifier: Apache-2.0
// A recording for reading: its segments as one, its cameras, their streams, and
// the position of each frame.
//
// Safe for untrusted files. Only the checksum of an image is checked, not its content:
// decoders must be safe themselves. Const functions may be called from any thread.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "record/byte_source.h"
#include "record/lacks.h"
#include "record/matroska_reader.h"
#include "record/segment_chain.h"
#include "wire/media_header.h"

namespace theatron::record {

// Small, because hours of many cameras have tens of millions of frames.
struct __attribute__((packed, aligned(4))) RecordedFrame {
    // Time since the recording's first frame. A pause between two segments counts at most
    // max_pause.
    Duration time() const { return Duration(time_us); }

    FrameNumber number = 0;
    std::uint32_t payload_size = 0;
    std::uint32_t payload_check = 0;
    std::int64_t time_us : 48 = 0;
    std::uint64_t segment : 16 = 0;  // its index
    std::uint64_t payload_at : 48 = 0;
    std::uint64_t side_gap : 14 = 0;  // from the payload's end to its header
    bool key : 1 = false;
    bool filtered : 1 = false;
};
static_assert(sizeof(RecordedFrame) == 28);

inline constexpr Duration max_pause = std::chrono::seconds(10);
// Frames of all segments together: ten times those of sixteen cameras with colour in eight hours.
inline constexpr std::size_t max_frames = std::size_t(1) << 28;

// The filters from this frame on, until the next entry.
struct FilterChange {
    std::size_t frame = 0;  // of those recorded
    std::string filters;    // docs/filters.md; empty: none
    bool operator==(const FilterChange&) const = default;
};

struct StreamContent {
    bool present = false;
    std::string codec;  // its setting: "zstd:delta=1"; of JPEG just "jpeg"
    int width = 0, height = 0;
    std::deque<RecordedFrame> frames;  // in the order in which they were recorded
    // The filters that were applied to depth before encoding; none before the first entry. A
    // voice has its speakers here (parse_speaker_note()).
    std::vector<FilterChange> filters;
    // Frames whose header is damaged or does not fit the stream.
    std::uint64_t damaged = 0;
};

// A segment's description of a camera, which applies from these frames on.
struct CameraPart {
    std::size_t segment = 0;  // its index
    std::size_t first_depth = 0, first_color = 0;
    std::string name;
    double frames_per_second = 0;
    Bytes calibration;
    StreamContent depth, color;  // without frames
};

struct CameraContent {
    CameraId id{};
    // As in the first segment that has the camera.
    std::string name;
    double frames_per_second = 0;
    Bytes calibration;
    StreamContent depth, color;
    std::vector<CameraPart> parts;  // by segment; at least one
};

// The voices of one track, in `frames`: Opus packets without gaps, of 10 ms to 120 ms. They are not
// counted as pictures anywhere.
struct VoiceContent {
    int track = 0;
    StreamContent content;
    struct Part {
        std::size_t segment = 0, first = 0;  // its index, and the first of its frames
        std::string name;                    // see VoiceTrack
    };
    std::vector<Part> parts;  // by segment; at least one
};

struct Segment {
    std::string file;  // empty: bytes in memory
    std::uint64_t bytes = 0;
    SegmentInfo info;
    bool has_info = false;  // false: of format version 1, without a session time
    UtcTime begin_utc;      // of its first frame; the epoch: not known
    // Its first block, and its last picture, or without any its last block: since the recording's
    // first block.
    Duration begin{}, end{};
    Duration last{};           // its last block, on the same scale
    Duration origin{};         // its own time 0, on the same scale
    TimePoint first_captured;  // session time of the first frame in the file
    std::uint64_t frames = 0;  // pictures
    std::uint64_t blocks = 0;  // those, parts of the room and packets of voices
    bool has_room = false;     // the state of the room was recorded
    bool closed = false;       // false: never closed, or cut off
    // Unless closed: the most that may be missing at its end; empty if unknown.
    std::optional<Duration> missing_end;
    // Bytes at the end that cannot be read although the file was closed, in which pictures may be.
    // They count as a damaged place.
    std::uint64_t unread_end = 0;
    std::uint32_t next = 0;     // of the segment that follows, as it says; 0: none
    std::string early_end;      // its writing failed: the tag's text (early_end_tag)
    Lacks lacks;                // as its recorder knew
    std::string recovered;      // a recovered file: losses_of() of the original
    bool head_damaged = false;  // and found whole elsewhere
    std::uint64_t damaged_places = 0, damaged_bytes = 0;
    std::uint64_t refused = 0;      // frames whose header is damaged or does not fit its stream
    std::uint64_t repeated = 0;     // second copies of frames, which are left out
    SegmentChain::Foreign foreign;  // other content behind it in its file, left out

    // True if nothing of it is damaged, and its file contains nothing else.
    bool intact() const {
        return !head_damaged && damaged_places == 0 && repeated == 0 && foreign.files == 0;
    }
    // True if it is as its recorder wrote it.
    bool is_whole() const { return closed && intact(); }
    // True if it also has all that was to be recorded, as far as its recorder knew.
    bool complete() const { return is_whole() && early_end.empty() && lacks.empty(); }
    // True if pictures may be missing at its end, not only the index.
    bool lacks_end() const { return !closed && (missing_end != Duration(0) || unread_end > 0); }
};

class RecordingFile {
public:
    // Opens `path` and the segments that follow it in the same folder, also under other names.
    // Throws Error with one sentence if it is no recording.
    static std::unique_ptr<RecordingFile> open(const std::filesystem::path& path);

    // The same without exceptions, for untrusted bytes: segments in any order. The first one must
    // be a recording; others that do not belong to it are left out.
    static Result<std::unique_ptr<RecordingFile>> read(
        std::vector<std::unique_ptr<ByteSource>> sources, std::vector<std::string> files = {});
    static Result<std::unique_ptr<RecordingFile>> read(std::unique_ptr<ByteSource> source);

    const std::vector<CameraContent>& cameras() const { return cameras_; }
    // Those of people who agreed to be recorded, by track.
    const std::vector<VoiceContent>& voices() const { return voices_; }
    // The parts of the room's state, if it was recorded (docs/formats/room.md): in `frames`, not
    // counted as pictures anywhere.
    const StreamContent& room() const { return room_; }
    const std::vector<Segment>& segments() const { return segments_; }
    // Segments missing before the first one and between it and the last one, one more if the last
    // one says that another follows, and at least as many as unreadable_files().
    std::uint64_t missing_segments() const { return missing_segments_; }
    // Files that follow by their names, and whose head is damaged in all its copies. Their pictures
    // are not read with the cameras of another segment, because a segment begins wherever
    // calibrations or codecs change.
    const std::vector<std::string>& unreadable_files() const { return unreadable_files_; }
    // Files that follow by their names, but do not continue the recording.
    const std::vector<std::string>& foreign_files() const { return foreign_files_; }
    // The file of the recording's segment 1, if a later one was opened and the earlier ones exist;
    // else empty.
    const std::string& begins_in() const { return begins_in_; }
    // False if a segment is missing, was never closed, was cut off, ended early or is damaged where
    // its elements show it, or if its recorder noted that something is missing. Damage inside a
    // picture is not known here.
    bool complete() const;
    // True if no segment is missing and nothing is damaged. Unclosed segments count as intact.
    bool intact() const;
    std::uint64_t bytes() const;
    // Frames whose header is damaged or does not fit its stream, of all streams.
    std::uint64_t refused() const { return refused_; }
    // From the first block to the end of the last segment.
    Duration duration() const { return duration_; }

    // The media header of a frame; its checksum was checked when the file was opened.
    Result<wire::MediaHeader> read_header(const RecordedFrame& frame) const;
    // Resizes `out` to the payload. truncated: the file ends before; malformed: it is damaged.
    Status read_payload(const RecordedFrame& frame, Bytes& out) const;

private:
    RecordingFile() = default;
    void add_segment(SegmentChain::Member member, SegmentChain& chain);
    // Adds this segment's voice tracks to voices_.
    void add_voices(const FoundHead& head, std::size_t segment);
    void leave_out_repeated(std::size_t segment, std::size_t first_room);
    void note_earlier(const std::vector<std::filesystem::path>& earlier);
    void place_segments();

    std::vector<std::shared_ptr<ByteSource>> sources_;
    std::vector<Segment> segments_;
    std::vector<CameraContent> cameras_;
    std::vector<VoiceContent> voices_;
    StreamContent room_;
    std::uint64_t refused_ = 0, missing_segments_ = 0;
    std::vector<std::string> unreadable_files_, foreign_files_;
    std::string begins_in_;
    std::size_t frames_ = 0;
    Duration duration_{};
};

}  // namespace theatron::record
