// SPDX-License-Identifier: Apache-2.0
#include "record/segment_writer.h"

#include <algorithm>

#include "record/picture_check.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

// Times from outside may have any value; they are limited so that their differences fit.
constexpr std::int64_t far_us = std::int64_t(1) << 60;

MatroskaWriter::Layout layout_of(const std::vector<RecordedCamera>& cameras,
                                 const SegmentInfo& info, bool replace,
                                 const std::string& recovered, bool has_room) {
    MatroskaWriter::Layout layout;
    layout.replace = replace;
    layout.side_name = side_name;
    layout.note_name = note_name;
    layout.check_name = check_name;
    layout.uid = make_uid();
    layout.family_uid = info.recording;
    layout.utc = info.clock.utc;
    layout.repeat_head = true;
    const auto add = [&](const RecordedCamera& camera, StreamId id, const RecordedStream& stream,
                         const char* codec_id) {
        Track track;
        track.number = track_number(id);
        track.name = camera.name;
        track.codec_id = codec_id;
        if (codec_id != std::string(jpeg_codec_id)) {
            const ByteView text = as_bytes(stream.codec);
            track.codec_private.assign(text.begin(), text.end());
        }
        track.width = stream.width;
        track.height = stream.height;
        track.frames_per_second = camera.frames_per_second;
        track.shown = !is_depth(id);
        layout.tracks.push_back(std::move(track));
    };
    // Tracks that players can play come first.
    for (const RecordedCamera& camera : cameras)
        if (camera.color) {
            const bool jpeg = camera.color->codec.starts_with("jpeg");
            add(camera, color_stream(camera.id), *camera.color,
                jpeg ? jpeg_codec_id : color_codec_id);
        }
    for (const RecordedCamera& camera : cameras) {
        add(camera, depth_stream(camera.id), camera.depth, depth_codec_id);
        layout.attachments.push_back(
            {calibration_name(camera.id), calibration_mime_type, camera.calibration});
    }
    if (has_room) {
        Track room;
        room.number = track_number(room_stream);
        room.is_video = false;
        room.name = room_track_name;
        room.codec_id = room_codec_id;
        room.shown = false;
        layout.tracks.push_back(std::move(room));
    }
    layout.attachments.push_back(
        {segment_info_name, segment_info_mime_type, encode_segment_info(info)});
    if (!recovered.empty())
        layout.tags.push_back({recovered_tag, recovered});
    return layout;
}

}  // namespace

std::int64_t block_time_us(TimePoint captured, TimePoint arrived, TimePoint begin) {
    const auto bounded = [](TimePoint t) {
        return Duration(std::clamp(to_us(t), -far_us, far_us));
    };
    const Duration age = bounded(arrived) - bounded(captured);
    const bool credible = -max_picture_lead <= age && age <= max_picture_age;
    const Duration at = bounded(credible ? captured : arrived) - bounded(begin);
    return std::clamp<std::int64_t>(at.count(), 0, max_block_us);
}

SegmentWriter::SegmentWriter(const std::filesystem::path& path,
                             const std::vector<RecordedCamera>& cameras, const SegmentInfo& info,
                             bool replace, const std::string& recovered, bool has_room)
    : begin_(info.clock.session),
      writer_(path, layout_of(cameras, info, replace, recovered, has_room)) {}

std::string SegmentWriter::write(std::span<const RecordedMessage> messages) {
    std::vector<Block> blocks;
    for (const RecordedMessage& one : messages) {
        const wire::MediaHeader& header = one.header;
        Block block;
        block.track = track_number(header.stream);
        block.time_us = block_time_us(header.captured, one.arrived, begin_);
        if (header.stream != room_stream) {
            first_us_ = any_ ? std::min(first_us_, block.time_us) : block.time_us;
            last_us_ = any_ ? std::max(last_us_, block.time_us) : block.time_us;
            any_ = true;
        }
        block.key = header.key;
        block.reference_us = block.time_us;
        if (const auto found = recent_us_.find({header.stream, header.reference});
            !header.key && found != recent_us_.end())
            block.reference_us = found->second;
        recent_us_[{header.stream, header.frame}] = block.time_us;
        block.payload = wire::media_payload(*one.message);
        block.side = ByteView(*one.message).first(wire::media_header_size);
        // Written at each change, and again in key frames, where reading may begin.
        std::string& filters = filters_[header.stream];
        if (is_depth(header.stream) &&
            (filters != one.filters || (header.key && !filters.empty()))) {
            filters = one.filters;
            block.note = filters.empty() ? no_filters : filters;
        }
        block.check = encode_check(
            check_of(block.track, block.time_us, block.side, block.note, block.payload));
        blocks.push_back(std::move(block));
    }
    // References reach back a few frames only.
    constexpr std::size_t many_recent = 4096;
    if (recent_us_.size() > many_recent)
        std::erase_if(recent_us_,
                      [&](const auto& entry) { return entry.second < last_us_ - 5'000'000; });
    return writer_.write(std::move(blocks));
}

}  // namespace theatron::record
