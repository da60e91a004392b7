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
#include "record/recorded_voice.h"
#include "record/segment_info.h"
#include "wire/media_header.h"

namespace theatron::record {

// A whole media message, unchanged.
struct RecordedMessage {
    wire::MediaHeader header;
    std::shared_ptr<const Bytes> message;
    // Depth: its filters (docs/filters.md), empty: none. A voice: its speaker
    // (speaker_note()).
    std::string filters;
    TimePoint arrived;  // session time
};

// A picture whose capture time is more than max_picture_age before its arrival, or more than
// max_picture_lead after it, gets the time of its arrival. Its header is not changed.
inline constexpr Duration max_picture_age = std::chrono::seconds(60);
inline constexpr Duration max_picture_lead = std::chrono::seconds(1);

// The time of a picture's block in a segment that began at `begin`: microseconds, from 0 to
// max_block_us for any values of the times.
std::int64_t block_time_us(TimePoint captured, TimePoint arrived, TimePoint begin);
inline constexpr std::int64_t max_block_us = std::int64_t(1) << 52;

class SegmentWriter {
public:
    struct Content {
        std::vector<RecordedCamera> cameras;
        std::vector<VoiceTrack> voices;
        bool has_room = false;  // messages of room_stream (recording_layout.h) will come, too
        bool operator==(const Content&) const = default;
    };
    // Creates the file; `replace`: in place of an existing one. `recovered`: losses of the original
    // of a recovered file; empty if there are none or it is no recovered file. Throws Error.
    SegmentWriter(const std::filesystem::path& path, const Content& content,
                  const SegmentInfo& info, bool replace = true, const std::string& recovered = {});

    // Each returns one sentence if it failed; then only finish() may be called.
    std::string write(std::span<const RecordedMessage> messages);
    std::string sync() { return writer_.sync(); }
    std::string finish() { return writer_.finish(); }
    void name_next(std::uint32_t number) { writer_.name_next(number); }
    void note_lacks(const std::string& letters) { writer_.note_lacks(letters); }

    std::uint64_t bytes() const { return writer_.bytes(); }
    std::uint64_t cut_bytes() const { return writer_.cut_bytes(); }
    std::string fate() const { return writer_.fate(); }
    // From the first block to the last picture, or without any to the last block.
    Duration duration() const { return Duration(last_us_ - first_us_); }

private:
    std::string note_of(const RecordedMessage& one);

    TimePoint begin_;
    MatroskaWriter writer_;
    std::map<std::pair<StreamId, FrameNumber>, std::int64_t> recent_us_;
    std::map<StreamId, std::string> filters_;  // of each stream's last frame
    std::map<StreamId, std::uint64_t> voice_blocks_;
    bool has_blocks_ = false, has_pictures_ = false;
    std::int64_t first_us_ = 0, last_us_ = 0;
};

}  // namespace theatron::record
