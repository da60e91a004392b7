// SPDX-License-Identifier: Apache-2.0
// Writes one segment of a recording: turns media messages into the blocks of a
// Matroska file (docs/formats/recording.md). One thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "record/matroska_writer.h"
#include "record/recorded_camera.h"
#include "record/segment_info.h"
#include "wire/media_header.h"

namespace theatron::record {

// A whole media message as it came.
struct RecordedMessage {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> message;
    std::string filters;  // that its depth went through (docs/filters.md); empty: none
    TimePoint arrived;    // session time
};

// A picture that says that it was taken longer than this before it arrived, or this much after,
// is placed where it arrived. Its header keeps what it says.
inline constexpr Duration max_picture_age = std::chrono::seconds(60);
inline constexpr Duration max_picture_lead = std::chrono::seconds(1);

// Where a picture stands in a segment that began at `begin`: microseconds, from 0 to
// max_block_us, whatever the times are.
std::int64_t block_time_us(TimePoint captured, TimePoint arrived, TimePoint begin);
inline constexpr std::int64_t max_block_us = std::int64_t(1) << 52;

class SegmentWriter {
public:
    // Creates the file, in place of one that is there. `recovered`: what was missing where this is
    // recovered from; empty: nothing, or it is not. Throws Error.
    SegmentWriter(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras,
                  const SegmentInfo& info, bool replace = true, const std::string& recovered = {});

    // Each returns one sentence if it failed. After that, only finish() makes sense.
    std::string write(std::span<const RecordedMessage> messages);
    std::string sync() { return writer_.sync(); }
    std::string finish() { return writer_.finish(); }

    std::uint64_t bytes() const { return writer_.bytes(); }
    std::uint64_t cut_bytes() const { return writer_.cut_bytes(); }
    // From the first block to the last.
    Duration duration() const { return Duration(last_us_ - first_us_); }

private:
    TimePoint begin_;
    MatroskaWriter writer_;
    std::map<std::pair<StreamId, FrameNumber>, std::int64_t> recent_us_;
    std::map<StreamId, std::string> filters_;  // of each stream's last frame
    bool any_ = false;
    std::int64_t first_us_ = 0, last_us_ = 0;
};

}  // namespace theatron::record
