// SPDX-License-Identifier: Apache-2.0
#include "record/recording_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/frame_order.h"
#include "base/outside_text.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

constexpr double usual_frames_per_second = 30;
constexpr std::size_t max_name = 4096;                       // characters
constexpr std::int64_t max_time_us = std::int64_t(1) << 44;  // of a frame in its segment
constexpr std::uint64_t max_side_gap = (1 << 14) - 1;
// Time of a recording that a crash of the machine usually loses: it was not synchronised yet.
constexpr Duration usual_unsynced = std::chrono::seconds(1);
constexpr std::uint64_t max_file_bytes = std::uint64_t(1) << 48;
// Matroska counts from 2001.
constexpr UtcTime matroska_epoch{std::chrono::sys_days(std::chrono::year(2001) / 1 / 1)};

// Rounded to a thousandth of a frame, because the duration was rounded to nanoseconds.
double frames_per_second(std::uint64_t default_duration_ns) {
    constexpr std::uint64_t shortest = 1'000'000, longest = 60'000'000'000;
    if (default_duration_ns < shortest || default_duration_ns > longest)
        return usual_frames_per_second;
    return std::round(1e12 / double(default_duration_ns)) / 1000;
}

std::string text_of(const Bytes& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// The cameras that a head describes; only those with depth.
std::map<CameraId, CameraPart> cameras_of(const FoundHead& head) {
    std::map<CameraId, CameraPart> cameras;
    for (const FoundTrack& track : head.tracks) {
        if (track.number < 1 || track.number > max_camera_track)
            continue;
        const StreamId id = stream_of_track(track.number);
        const bool is_jpeg = track.codec_id == jpeg_codec_id;
        if (is_depth(id) ? track.codec_id != depth_codec_id
                         : !is_jpeg && track.codec_id != color_codec_id)
            continue;
        CameraPart& camera = cameras[camera_of(id)];
        camera.name = clean_text(track.name, max_name);
        camera.frames_per_second = frames_per_second(track.default_duration_ns);
        StreamContent& stream = is_depth(id) ? camera.depth : camera.color;
        stream.present = true;
        stream.codec = is_jpeg ? "jpeg" : clean_text(text_of(track.codec_private), max_note);
        stream.width = track.width;
        stream.height = track.height;
    }
    std::erase_if(cameras, [](const auto& entry) { return !entry.second.depth.present; });
    for (const FoundAttachment& attachment : head.attachments)
        for (auto& [id, camera] : cameras)
            if (attachment.name == calibration_name(id))
                camera.calibration = attachment.bytes;
    return cameras;
}

bool has_room(const FoundHead& head) {
    return std::any_of(head.tracks.begin(), head.tracks.end(), [](const FoundTrack& t) {
        return t.number == track_number(room_stream) && t.codec_id == room_codec_id;
    });
}

// The header of a block, if the checks of block and header pass.
std::optional<wire::MediaHeader> header_of(const FoundBlock& block, StreamId id, bool is_checked) {
    if (!block.side || (is_checked && !block.check))
        return std::nullopt;
    if (is_checked && decode_check(*block.check).head !=
                          head_check(block.track, block.time_us, *block.side, as_bytes(block.note)))
        return std::nullopt;
    const auto header = wire::parse_header_alone(*block.side);
    const std::uint64_t payload_end = block.payload_at + block.payload_size;
    if (!header || header->stream != id || header->payload_size != block.payload_size ||
        header->slices != 1 || block.side_at < payload_end ||
        block.side_at - payload_end > max_side_gap)
        return std::nullopt;
    return *header;
}

void note_filters(StreamContent& stream, const std::string& note) {
    std::string filters = note == no_filters ? "" : clean_text(note, max_note);
    if (filters.size() > max_note)
        filters = unnamed_filters;
    const bool is_new = stream.filters.empty() || stream.filters.back().filters != filters;
    if (!note.empty() && is_new)
        stream.filters.push_back({stream.frames.size(), std::move(filters)});
}

void note_speaker(StreamContent& voice, const std::string& note) {
    std::string speaker = clean_text(note, max_note);
    const bool is_new = voice.filters.empty() || voice.filters.back().filters != speaker;
    if (!note.empty() && is_new)
        voice.filters.push_back({voice.frames.size(), std::move(speaker)});
}

}  // namespace

void RecordingFile::add_voices(const FoundHead& head, std::size_t segment) {
    for (const FoundTrack& track : head.tracks) {
        if (track.number < 1 || !is_voice(stream_of_track(track.number)) ||
            track.codec_id != voice_codec_id)
            continue;
        auto voice = std::find_if(voices_.begin(), voices_.end(),
                                  [&](const VoiceContent& v) { return v.track == track.number; });
        if (voice == voices_.end()) {
            voices_.push_back({track.number, {}, {}});
            voice = voices_.end() - 1;
            voice->content.present = true;
            voice->content.codec = "opus";
        } else if (voice->parts.back().segment == segment) {
            continue;  // a second track of this number
        }
        voice->parts.push_back(
            {segment, voice->content.frames.size(), clean_text(track.name, max_name)});
        // Another segment may have another speaker.
        if (!voice->content.filters.empty())
            voice->content.filters.push_back({voice->content.frames.size(), ""});
    }
}

void RecordingFile::add_segment(SegmentChain::Member member, SegmentChain& chain) {
    const FoundHead& head = member.head;
    const std::optional<SegmentInfo>& info = member.info;
    Segment segment;
    segment.file = member.file;
    segment.has_info = info.has_value();
    if (info)
        segment.info = *info;
    else if (head.date_ns > 0)
        segment.info.clock.utc = matroska_epoch + std::chrono::microseconds(head.date_ns / 1000);
    segment.head_damaged = head.damaged;

    const std::size_t index = segments_.size();
    std::map<StreamId, StreamContent*> streams;
    for (auto& [id, part] : cameras_of(head)) {
        // A second name, because clang 14 does not let a lambda use a structured binding.
        auto camera =
            std::find_if(cameras_.begin(), cameras_.end(),
                         [wanted = id](const CameraContent& c) { return c.id == wanted; });
        if (camera == cameras_.end()) {
            cameras_.push_back({id,
                                part.name,
                                part.frames_per_second,
                                part.calibration,
                                part.depth,
                                part.color,
                                {}});
            camera = cameras_.end() - 1;
        } else if (!camera->color.present) {
            camera->color = part.color;
        }
        part.segment = index;
        part.first_depth = camera->depth.frames.size();
        part.first_color = camera->color.frames.size();
        camera->parts.push_back(part);
    }
    for (CameraContent& camera : cameras_) {
        if (camera.parts.back().segment != index)
            continue;
        streams[depth_stream(camera.id)] = &camera.depth;
        if (camera.parts.back().color.present)
            streams[color_stream(camera.id)] = &camera.color;
    }

    if (info)
        add_voices(head, index);
    for (VoiceContent& voice : voices_)
        if (voice.parts.back().segment == index)
            streams[stream_of_track(voice.track)] = &voice.content;

    const auto is_listed = [&](int track) {
        return std::any_of(head.tracks.begin(), head.tracks.end(),
                           [&](const FoundTrack& t) { return t.number == track; });
    };
    segment.has_room = info && has_room(head);
    if (segment.has_room)
        streams[room_stream] = &room_;
    room_.present |= segment.has_room;
    const std::size_t first_room = room_.frames.size();
    std::optional<Duration> first_block, last_picture;
    Duration last_block{};
    std::optional<TimePoint> first_captured;
    const auto visit = [&](const FoundBlock& block) {
        // A file has blocks of its own tracks only, those that this reader does not know included.
        if (!is_listed(block.track)) {
            ++refused_;
            ++segment.refused;
            return;
        }
        if (block.track < 1)
            return;
        const StreamId id = stream_of_track(block.track);
        const auto at = streams.find(id);
        if (at == streams.end())
            return;
        StreamContent& stream = *at->second;
        const auto header = header_of(block, id, info.has_value());
        // Version 1 says the exact time in the header only, and may have begun before time 0.
        const bool is_picture = id != room_stream && !is_voice(id);
        if (header && !first_captured && is_picture)
            first_captured = header->captured;
        const std::int64_t time_us =
            header && !info ? (header->captured - *first_captured).count() : block.time_us;
        if (!header || std::abs(time_us) > max_time_us || block.payload_at >= max_file_bytes ||
            frames_ >= max_frames) {
            ++stream.damaged;
            ++refused_;
            ++segment.refused;
            return;
        }
        ++frames_;
        const Duration time(time_us);
        ++segment.blocks;
        first_block = std::min(first_block.value_or(time), time);
        last_block = std::max(last_block, time);
        if (is_picture) {
            ++segment.frames;
            last_picture = std::max(last_picture.value_or(time), time);
        }
        if (is_voice(id))
            note_speaker(stream, block.note);
        else if (is_depth(id))
            note_filters(stream, block.note);
        RecordedFrame frame;
        frame.number = header->frame;
        frame.payload_size = block.payload_size;
        frame.payload_check = info ? decode_check(*block.check).payload : 0;
        frame.time_us = time_us;
        frame.segment = index;
        frame.payload_at = block.payload_at;
        frame.side_gap = block.side_at - block.payload_at - block.payload_size;
        frame.key = header->key;
        frame.filtered = header->filtered != TimePoint{};
        stream.frames.push_back(frame);
    };
    bool has_end = false;
    std::uint64_t cut_in_clusters = 0;
    const std::uint64_t whole = member.source->size();
    std::uint64_t end = 0;  // of the segment in its file
    for (std::optional<std::uint64_t> at = head.clusters_at; at;) {
        FoundHead from_here = head;
        from_here.clusters_at = *at;
        const FoundClusters found = read_clusters(*member.source, from_here, visit);
        segment.damaged_places += found.damaged_places;
        segment.damaged_bytes += found.damaged_bytes;
        has_end = found.has_end;
        cut_in_clusters = found.cut_in_clusters ? found.cut_bytes : 0;
        end = found.next_file_at.value_or(whole);
        segment.bytes += end - (segment.bytes == 0 ? 0 : *at);
        at.reset();
        if (found.next_file_at) {
            const SegmentChain::Behind behind = chain.add_behind(member, end);
            segment.foreign.add(behind.foreign);
            at = behind.goes_on_at;
            segment.damaged_places += behind.repeated_head_bytes > 0;
            segment.damaged_bytes += behind.repeated_head_bytes;
            segment.bytes += behind.repeated_head_bytes;
        }
    }
    segment.begin = first_block.value_or(Duration(0));
    segment.end = last_picture.value_or(last_block);
    segment.last = std::max(last_block, segment.begin);
    segment.first_captured = first_captured.value_or(TimePoint{});
    if (info || head.date_ns > 0)
        segment.begin_utc = segment.info.clock.utc + (info ? segment.begin : Duration(0));
    segment.closed = has_end || (head.segment_end > 0 && head.segment_end <= segment.bytes);
    segment.bytes += segment.foreign.bytes;
    if (end < whole)
        member.source = std::make_shared<PartSource>(member.source, 0, end);
    if (!segment.closed && head.duration_us > 0) {
        segment.missing_end = std::max(Duration(head.duration_us) - last_block, Duration(0)) +
                              (head.segment_end == 0 ? usual_unsynced : Duration(0));
        // The last block is there, so another one beside it is damaged, for example of another
        // camera.
        if (*segment.missing_end == Duration(0) && cut_in_clusters > 0) {
            segment.unread_end = cut_in_clusters;
            ++segment.damaged_places;
            segment.damaged_bytes += cut_in_clusters;
        }
    }
    segment.early_end = clean_text(head.early_end, max_note);
    segment.lacks = lacks_of_letters(head.lacks);
    segment.next = head.next_segment;
    segment.recovered = clean_text(head.recovered, max_note);
    segments_.push_back(std::move(segment));
    sources_.push_back(std::move(member.source));
    leave_out_repeated(index, first_room);
}

// Drops the second copies of frames that a segment contains twice, for example because a part of
// the file was copied behind itself.
void RecordingFile::leave_out_repeated(std::size_t segment, std::size_t first_room) {
    if (!segments_[segment].has_info)
        return;  // in version 1 numbers may restart
    const auto leave_out = [&](StreamContent& stream, std::size_t begin, bool is_pictures) {
        auto& frames = stream.frames;
        const auto is_behind = [](const RecordedFrame& a, const RecordedFrame& b) {
            return frames_after(b.number, a.number) <= 0;
        };
        const auto first = frames.begin() + std::ptrdiff_t(begin);
        if (std::adjacent_find(first, frames.end(), is_behind) == frames.end())
            return;
        std::vector<std::uint32_t> order(frames.size() - begin);
        std::iota(order.begin(), order.end(), 0u);
        const auto name_of = [&](std::uint32_t i) {
            const RecordedFrame& f = frames[begin + i];
            return std::tuple(f.number, std::int64_t(f.time_us), f.payload_size, f.payload_check);
        };
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(name_of(a), a) < std::pair(name_of(b), b);
        });
        std::vector<bool> is_repeated(order.size());
        for (std::size_t i = 1; i < order.size(); ++i)
            is_repeated[order[i]] = name_of(order[i]) == name_of(order[i - 1]);
        std::size_t kept = begin;
        auto change = stream.filters.begin();
        for (std::size_t i = begin; i < frames.size(); ++i) {
            for (; change != stream.filters.end() && change->frame <= i; ++change)
                change->frame = std::min(change->frame, kept);
            if (!is_repeated[i - begin])
                frames[kept++] = frames[i];
        }
        const std::uint64_t repeated = frames.size() - kept;
        frames.resize(kept);
        std::erase_if(stream.filters, [&](const FilterChange& c) { return c.frame >= kept; });
        segments_[segment].repeated += repeated;
        segments_[segment].frames -= is_pictures ? repeated : 0;
        frames_ -= repeated;
    };
    for (CameraContent& camera : cameras_)
        if (const CameraPart& part = camera.parts.back(); part.segment == segment) {
            leave_out(camera.depth, part.first_depth, true);
            leave_out(camera.color, part.first_color, true);
        }
    for (VoiceContent& voice : voices_)
        if (const VoiceContent::Part& part = voice.parts.back(); part.segment == segment)
            leave_out(voice.content, part.first, false);
    leave_out(room_, first_room, false);
}

// Puts the segments one behind the other, and moves all frames to where they then are.
void RecordingFile::place_segments() {
    std::vector<Duration> moves;
    const Segment* before = nullptr;  // with blocks
    Segment original_before;
    for (Segment& segment : segments_) {
        const Segment original = segment;  // its times count from its own beginning
        Duration begin{};
        if (before && segment.blocks > 0) {
            const auto clock_step = [](const Segment& s) {
                return s.info.clock.utc.time_since_epoch() - Duration(to_us(s.info.clock.session));
            };
            // The wall's clock may have been set meanwhile; the session's, if it went on, was not.
            constexpr Duration same_clock = std::chrono::seconds(2);
            const Duration step = clock_step(original) - clock_step(original_before);
            const Duration session_pause =
                (original.info.clock.session + original.begin) -
                (original_before.info.clock.session + original_before.end);
            const Duration utc_pause = session_pause + step;
            const bool is_same = -same_clock < step && step < same_clock;
            // Speech may go on where the pictures have ended. Streams change to the next segment
            // one after the other (Intake::describe()), so its beginning may overlap the end of the
            // segment before.
            constexpr Duration longest_overlap = std::chrono::seconds(5);
            const bool overlaps =
                is_same && session_pause < Duration(0) && session_pause > -longest_overlap;
            const Duration shortest = overlaps
                                          ? std::max(session_pause, before->begin - before->end)
                                          : Duration(std::chrono::milliseconds(1));
            const Duration longest = before->last - before->end + max_pause;
            begin =
                before->end + std::clamp(is_same ? session_pause : utc_pause, shortest, longest);
            begin = std::min(begin, Duration(2 * max_time_us));
        }
        const Duration move = segment.blocks > 0 ? begin - segment.begin : Duration(0);
        moves.push_back(move);
        segment.origin = move;
        segment.begin += move;
        segment.end += move;
        segment.last += move;
        if (segment.blocks > 0) {
            before = &segment;
            original_before = original;
            duration_ = std::max(duration_, segment.end);
        }
    }
    for (CameraContent& camera : cameras_)
        for (StreamContent* stream : {&camera.depth, &camera.color})
            for (RecordedFrame& frame : stream->frames)
                frame.time_us = frame.time_us + moves[frame.segment].count();
    std::vector<StreamContent*> beside{&room_};
    for (VoiceContent& voice : voices_)
        beside.push_back(&voice.content);
    for (StreamContent* stream : beside)
        for (RecordedFrame& frame : stream->frames)
            frame.time_us = std::max<std::int64_t>(frame.time_us + moves[frame.segment].count(), 0);
}

Result<std::unique_ptr<RecordingFile>> RecordingFile::read(
    std::vector<std::unique_ptr<ByteSource>> sources, std::vector<std::string> files) {
    Result<SegmentChain> chain = SegmentChain::read(std::move(sources), std::move(files));
    if (!chain)
        return chain.error();
    std::unique_ptr<RecordingFile> recording(new RecordingFile);
    for (std::optional<SegmentChain::Member> member; (member = chain->take());) {
        const bool is_first = recording->segments_.empty();
        if (is_first && cameras_of(member->head).empty() &&
            !(member->info && has_room(member->head)))
            return Status::unsupported;
        recording->add_segment(*std::move(member), *chain);
    }
    recording->missing_segments_ = chain->missing();
    recording->unreadable_files_ = chain->unreadable();
    recording->foreign_files_ = chain->foreign();
    std::sort(recording->cameras_.begin(), recording->cameras_.end(),
              [](const CameraContent& a, const CameraContent& b) { return a.id < b.id; });
    recording->place_segments();
    return recording;
}

Result<std::unique_ptr<RecordingFile>> RecordingFile::read(std::unique_ptr<ByteSource> source) {
    std::vector<std::unique_ptr<ByteSource>> sources;
    sources.push_back(std::move(source));
    return read(std::move(sources));
}

bool RecordingFile::intact() const {
    return missing_segments_ == 0 && refused_ == 0 &&
           std::all_of(segments_.begin(), segments_.end(),
                       [](const Segment& s) { return s.intact(); });
}

bool RecordingFile::complete() const {
    return missing_segments_ == 0 && std::all_of(segments_.begin(), segments_.end(),
                                                 [](const Segment& s) { return s.complete(); });
}

std::uint64_t RecordingFile::bytes() const {
    std::uint64_t bytes = 0;
    for (const Segment& segment : segments_)
        bytes += segment.bytes;
    return bytes;
}

Result<wire::MediaHeader> RecordingFile::read_header(const RecordedFrame& frame) const {
    EncodedHeader bytes;
    const std::uint64_t at = frame.payload_at + frame.payload_size + frame.side_gap;
    if (!sources_[frame.segment]->read(at, bytes))
        return Status::truncated;
    return wire::parse_header_alone(bytes);
}

Status RecordingFile::read_payload(const RecordedFrame& frame, Bytes& out) const {
    out.resize(frame.payload_size);
    ByteSource& source = *sources_[frame.segment];
    if (!source.read(frame.payload_at, out))
        return Status::truncated;
    const bool is_checked = segments_[frame.segment].has_info;
    return is_checked && crc32c(out) != frame.payload_check ? Status::malformed : Status::ok;
}

}  // namespace theatron::record
