// SPDX-License-Identifier: Apache-2.0
#include "record/segment_writer.h"

#include <algorithm>
#include <utility>

#include "record/picture_check.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

// Times from outside may have any value; they are limited so that their differences fit.
constexpr std::int64_t far_us = std::int64_t(1) << 60;
// Blocks of a voice, of which the first names the speaker: at most 12 s.
constexpr std::uint64_t blocks_of_a_speaker = 100;

// RFC 7845, 5.1: one channel, 312 samples of the encoder's delay, made from 48 kHz, no gain.
Bytes opus_head() {
    Bytes head;
    ByteWriter out(head);
    out.put_bytes(as_bytes("OpusHead"));
    out.put(std::uint8_t(1));  // version
    out.put(std::uint8_t(1));  // channels
    out.put(std::uint16_t(312));
    out.put(std::uint32_t(48'000));
    out.put(std::uint16_t(0));  // gain
    out.put(std::uint8_t(0));   // mapping of channels
    return head;
}

MatroskaWriter::Layout layout_of(const SegmentWriter::Content& content, const SegmentInfo& info,
                                 bool replace, const std::string& recovered) {
    const std::vector<RecordedCamera>& cameras = content.cameras;
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
    for (const VoiceTrack& voice : content.voices) {
        Track track;
        track.number = voice.number;
        track.kind = TrackKind::opus;
        track.name = voice.name;
        track.codec_id = voice_codec_id;
        track.codec_private = opus_head();
        track.note_name = speaker_note_name;
        layout.tracks.push_back(std::move(track));
    }
    if (content.has_room) {
        Track room;
        room.number = track_number(room_stream);
        room.kind = TrackKind::metadata;
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

SegmentWriter::SegmentWriter(const std::filesystem::path& path, const Content& content,
                             const SegmentInfo& info, bool replace, const std::string& recovered)
    : begin_(info.clock.session), writer_(path, layout_of(content, info, replace, recovered)) {}

// The line beside a block of depth or of a voice; empty: none.
std::string SegmentWriter::note_of(const RecordedMessage& one) {
    const wire::MediaHeader& header = one.header;
    std::string& last = filters_[header.stream];
    if (is_voice(header.stream)) {
        // Repeated, so that damage to one block does not hide the speaker of many.
        const bool repeats = voice_blocks_[header.stream]++ % blocks_of_a_speaker == 0;
        if (std::exchange(last, one.filters) == one.filters && !repeats)
            return {};
        return one.filters;
    }
    // Written at each change, and again in key frames, where reading may begin.
    if (!is_depth(header.stream) || (last == one.filters && (!header.key || last.empty())))
        return {};
    last = one.filters;
    return last.empty() ? no_filters : last;
}

std::string SegmentWriter::write(std::span<const RecordedMessage> messages) {
    std::vector<Block> blocks;
    std::map<int, std::int64_t> newest_us;  // by track
    for (const RecordedMessage& one : messages) {
        const wire::MediaHeader& header = one.header;
        Block block;
        block.track = track_number(header.stream);
        const bool is_speech = is_voice(header.stream);
        // Nobody is to move what was put into a sequence.
        block.time_us =
            block_time_us(header.captured, is_speech ? header.captured : one.arrived, begin_);
        // The blocks are sorted by time, and a stream's pictures must stay in their order: one that
        // is sent again may say that it is older than the one that it replaces.
        if (!is_speech) {
            std::int64_t& newest = newest_us[block.track];
            newest = block.time_us = std::max(block.time_us, newest);
        }
        const bool is_picture = header.stream != room_stream && !is_speech;
        first_us_ = has_blocks_ ? std::min(first_us_, block.time_us) : block.time_us;
        if (is_picture || !has_pictures_)
            last_us_ = has_blocks_ ? std::max(last_us_, block.time_us) : block.time_us;
        has_blocks_ = true;
        has_pictures_ |= is_picture;
        block.key = header.key;
        block.indexed = !is_speech;
        block.reference_us = block.time_us;
        if (const auto found = recent_us_.find({header.stream, header.reference});
            !header.key && found != recent_us_.end())
            block.reference_us = found->second;
        if (!is_speech)
            recent_us_[{header.stream, header.frame}] = block.time_us;
        block.payload = wire::media_payload(*one.message);
        block.side = ByteView(*one.message).first(wire::media_header_size);
        block.note = note_of(one);
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
