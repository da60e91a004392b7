// SPDX-License-Identifier: Apache-2.0
// A recording to read: its cameras, their streams, and where each frame is.
//
// Safe for untrusted files. Images are not looked into: whoever decodes them
// does so with codecs that are safe themselves.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/status.h"
#include "record/byte_source.h"
#include "wire/media_header.h"

namespace theatron::record {

struct RecordedFrame {
    wire::MediaHeader header;
    std::uint64_t payload_at = 0;
};

// From this frame on, until the next of these.
struct FilterChange {
    std::size_t frame = 0;  // of those recorded
    std::string filters;    // docs/filters.md; empty: none
    bool operator==(const FilterChange&) const = default;
};

struct StreamContent {
    bool present = false;
    std::string codec;  // its setting: "zstd:delta=1"; of JPEG just "jpeg"
    int width = 0, height = 0;
    std::vector<RecordedFrame> frames;  // in the order in which they were recorded
    // Which filters depth went through before it was encoded; none before the first.
    std::vector<FilterChange> filters;
};

struct CameraContent {
    CameraId id{};
    std::string name;
    double frames_per_second = 0;
    Bytes calibration;
    StreamContent depth, color;
};

class RecordingFile {
public:
    // Throws Error with one sentence if it is no recording.
    static std::unique_ptr<RecordingFile> open(const std::filesystem::path& path);

    // The same without exceptions, for bytes from anywhere.
    static Result<std::unique_ptr<RecordingFile>> read(std::unique_ptr<ByteSource> source);

    const std::vector<CameraContent>& cameras() const { return cameras_; }
    // False if the recording was never closed, or the file was cut off or damaged.
    bool complete() const { return complete_; }
    std::uint64_t bytes() const { return source_->size(); }
    // Frames whose header is damaged or does not fit its stream.
    std::uint64_t refused() const { return refused_; }

    // Exposure of the first frame and of the last, of all streams.
    TimePoint begin() const { return begin_; }
    TimePoint end() const { return end_; }

    Status read_payload(const RecordedFrame& frame, Bytes& out) const;

private:
    explicit RecordingFile(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}

    std::unique_ptr<ByteSource> source_;
    std::vector<CameraContent> cameras_;
    bool complete_ = false;
    std::uint64_t refused_ = 0;
    TimePoint begin_, end_;
};

}  // namespace theatron::record
