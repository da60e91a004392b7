// SPDX-License-Identifier: Apache-2.0
#include "record/recover.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "base/error.h"
#include "record/crc32c.h"
#include "record/recording_layout.h"
#include "record/remarks.h"
#include "record/segment_writer.h"

namespace theatron::record {
namespace {

constexpr std::size_t batch_bytes = std::size_t(4) << 20;
constexpr std::size_t kept_numbers = 64;  // references reach back a few frames only

// Reads the frames of a stream one after another.
class StreamReader {
public:
    StreamReader(const StreamContent& stream, RecoveredStream& counts)
        : stream_(stream), counts_(counts) {
        counts_.damaged += stream.damaged;
    }

    // The next frame of this segment; null at its end.
    const RecordedFrame* upcoming(std::size_t segment) const {
        const bool there =
            next_ < stream_.frames.size() && stream_.frames[next_].segment == segment;
        return there ? &stream_.frames[next_] : nullptr;
    }

    void begin_segment(std::size_t segment) {
        kept_.clear();
        last_.reset();
        written_.clear();
        may_repeat_ = !numbers_only_grow(segment);
    }

    // The upcoming frame is earlier than the one before it: here the file is not in the order in
    // which it was recorded.
    bool goes_back() const { return last_ && stream_.frames[next_].time() < *last_; }

    // Moves on; false if the frame is not to be kept. `begin`: session time of the segment's time
    // 0.
    bool take(const RecordingFile& recording, TimePoint begin, RecordedMessage& out) {
        // A reference across such a place may be to another picture with the same number.
        if (goes_back())
            kept_.clear();
        const RecordedFrame& frame = stream_.frames[next_++];
        last_ = frame.time();
        for (; change_ < stream_.filters.size() && stream_.filters[change_].frame < next_;
             ++change_)
            filters_ = stream_.filters[change_].filters;
        const auto header = recording.read_header(frame);
        if (!header || recording.read_payload(frame, payload_) != Status::ok) {
            ++counts_.damaged;
            return false;
        }
        const bool has_reference =
            header->key || std::find(kept_.begin(), kept_.end(), header->reference) != kept_.end();
        if (!has_reference) {
            ++counts_.undecodable;
            return false;
        }
        if (may_repeat_ && !is_new(*header, block_time_us(header->captured, out.arrived, begin))) {
            ++counts_.repeated;
            return false;
        }
        kept_.push_back(header->frame);
        if (kept_.size() > kept_numbers)
            kept_.pop_front();
        auto message = std::make_shared<Bytes>(wire::media_header_size);
        wire::write_media_header(*header, message->data());
        message->insert(message->end(), payload_.begin(), payload_.end());
        out.header = *header;
        out.message = std::move(message);
        out.filters = filters_;
        const bool is_silence = is_voice(header->stream) && header->codec == silence_codec;
        ++(is_silence ? counts_.silent : counts_.saved);
        return true;
    }

private:
    // True if frame numbers only grow: then the segment has no second copies to search for.
    bool numbers_only_grow(std::size_t segment) const {
        std::int64_t grown = 0;
        for (std::size_t i = next_ + 1;
             i < stream_.frames.size() && stream_.frames[i].segment == segment; ++i) {
            const auto step = std::int32_t(stream_.frames[i].number - stream_.frames[i - 1].number);
            grown += step;
            if (step <= 0 || grown > std::numeric_limits<std::int32_t>::max())
                return false;
        }
        return true;
    }

    // A reader leaves out repetitions (docs/formats/recording.md). In files of version 1 it cannot
    // recognise them, and all frames that were earlier than time 0 are placed at time 0.
    bool is_new(const wire::MediaHeader& header, std::int64_t time_us) {
        return written_.emplace(header.frame, time_us, payload_.size(), crc32c(payload_)).second;
    }

    const StreamContent& stream_;
    RecoveredStream& counts_;
    std::size_t next_ = 0;
    std::size_t change_ = 0;
    std::string filters_;
    std::deque<FrameNumber> kept_;
    std::optional<Duration> last_;
    bool may_repeat_ = false;
    // Number, time, size and checksum of the frames of this segment.
    std::set<std::tuple<FrameNumber, std::int64_t, std::size_t, std::uint32_t>> written_;
    Bytes payload_;
};

std::vector<RecordedCamera> cameras_in(const RecordingFile& recording, std::size_t segment) {
    std::vector<RecordedCamera> cameras;
    for (const CameraContent& content : recording.cameras())
        for (const CameraPart& part : content.parts) {
            if (part.segment != segment)
                continue;
            RecordedCamera camera{content.id,
                                  part.name,
                                  part.frames_per_second,
                                  part.calibration,
                                  {part.depth.codec, part.depth.width, part.depth.height},
                                  {}};
            if (part.color.present)
                camera.color =
                    RecordedStream{part.color.codec, part.color.width, part.color.height};
            cameras.push_back(std::move(camera));
        }
    return cameras;
}

std::vector<VoiceTrack> voices_in(const RecordingFile& recording, std::size_t segment) {
    std::vector<VoiceTrack> voices;
    for (const VoiceContent& voice : recording.voices())
        for (const VoiceContent::Part& part : voice.parts)
            if (part.segment == segment)
                voices.push_back({voice.track, part.name});
    return voices;
}

std::uint64_t voice_blocks_in(const RecordingFile& recording) {
    std::uint64_t blocks = 0;
    for (const VoiceContent& voice : recording.voices())
        blocks += voice.content.frames.size();
    return blocks;
}

struct Written {
    std::uint64_t pictures = 0, room_parts = 0, voice_blocks = 0;
};

// Reads the new file again and checks that it is whole and has what is expected.
void check(const std::filesystem::path& file, const Written& expected) {
    const auto written = RecordingFile::read(open_file_source(file));
    if (!written || !(*written)->segments()[0].is_whole() || (*written)->refused() > 0 ||
        (*written)->segments()[0].frames != expected.pictures ||
        (*written)->room().frames.size() != expected.room_parts ||
        voice_blocks_in(**written) != expected.voice_blocks)
        throw Error("What was saved into '" + file.string() +
                    "' is not what can be read from it; its disk may be failing.");
}

// Files that get their names when all of them are whole, and are removed otherwise:
// keep() says that they are.
class NewFiles {
public:
    ~NewFiles() {
        std::error_code ignored;
        for (const std::filesystem::path& file : files_)
            std::filesystem::remove(draft_of(file), ignored);
    }
    // Returns where to write the file.
    std::filesystem::path add(const std::filesystem::path& file) {
        files_.push_back(file);
        // Left by a program that was killed.
        std::error_code ignored;
        std::filesystem::remove(draft_of(file), ignored);
        return draft_of(file);
    }
    void keep() {
        for (const std::filesystem::path& file : files_)
            std::filesystem::rename(draft_of(file), file);
        files_.clear();
    }

private:
    static std::filesystem::path draft_of(std::filesystem::path file) { return file += ".part"; }

    std::vector<std::filesystem::path> files_;
};

// The reasons for which the new files lack something that was to be recorded.
Lacks lacks_of(const RecordingFile& recording, const Recovered& result) {
    Lacks lacks;
    if (recording.missing_segments() > 0 || !recording.unreadable_files().empty())
        lacks.insert(Lack::files);
    for (const Segment& segment : recording.segments()) {
        lacks.insert(segment.lacks.begin(), segment.lacks.end());
        if (!segment.early_end.empty() || segment.lacks_end() || segment.damaged_places > 0 ||
            segment.refused > 0)
            lacks.insert(Lack::pictures);
    }
    const auto add = [&](const RecoveredStream& stream) {
        if (stream.damaged > 0 || stream.undecodable > 0)
            lacks.insert(Lack::pictures);
    };
    for (const Recovered::Camera& camera : result.cameras) {
        add(camera.depth);
        add(camera.color);
    }
    add(result.room);
    add(result.voices);
    return lacks;
}

bool saved_all(const RecordingFile& recording, const Lacks& lacks) {
    return lacks.empty() && std::ranges::all_of(recording.segments(), [](const Segment& segment) {
               return segment.closed && segment.foreign.files == 0;
           });
}

bool has_content(const Recovered& result) {
    std::uint64_t saved = result.room.saved + result.voices.saved;
    for (const Recovered::Camera& camera : result.cameras)
        saved += camera.depth.saved + camera.color.saved;
    return saved > 0;
}

// The last file says what its recording lacks, as that of a recorder does.
void note_lacks(SegmentWriter& writer, const Lacks& lacks) {
    if (!lacks.empty())
        writer.note_lacks(letters_of(lacks));
}

// The writer's own sentence is about a recording that ends early, and keeps what it has.
void require_written(const std::string& problem, const std::filesystem::path& file) {
    if (!problem.empty())
        throw Error("'" + file.string() +
                    "' could not be written to its end, since its disk is full or fails. What was "
                    "copied is removed; the recording itself is as it was.");
}

}  // namespace

Recovered recover(const RecordingFile& recording, const std::filesystem::path& out,
                  const std::function<void(double)>& progress) {
    if (const std::string problem = name_problem(out); !problem.empty())
        throw Error(problem);
    Recovered result;
    result.cameras.resize(recording.cameras().size());
    std::vector<StreamReader> streams;
    for (std::size_t i = 0; i < recording.cameras().size(); ++i) {
        const CameraContent& camera = recording.cameras()[i];
        streams.emplace_back(camera.depth, result.cameras[i].depth);
        streams.emplace_back(camera.color, result.cameras[i].color);
    }
    for (const VoiceContent& voice : recording.voices())
        streams.emplace_back(voice.content, result.voices);
    streams.emplace_back(recording.room(), result.room);
    NewFiles new_files;
    std::uint64_t bytes_before = 0;
    const Uid new_uid = make_uid();
    for (std::size_t s = 0; s < recording.segments().size(); ++s) {
        const Segment& segment = recording.segments()[s];
        const auto file = segment_path(out, std::uint32_t(s + 1));
        std::error_code ignored;
        if (std::filesystem::exists(file, ignored))
            throw Error("'" + file.string() + "' exists already; name another file.");
        const std::filesystem::path draft = new_files.add(file);
        SegmentInfo info = segment.info;
        // Files of version 1 have no session time: it is taken from the media headers.
        if (!segment.has_info) {
            info.recording = new_uid;
            info.clock.session = segment.first_captured;
        }
        const SegmentWriter::Content content{cameras_in(recording, s), voices_in(recording, s),
                                             segment.has_room};
        SegmentWriter writer(draft, content, info, true, losses_of(segment));
        std::vector<RecordedMessage> messages;
        std::size_t waiting = 0;
        Written written;
        const auto flush = [&] {
            for (const RecordedMessage& message : messages)
                ++(message.header.stream == room_stream ? written.room_parts
                   : is_voice(message.header.stream)    ? written.voice_blocks
                                                        : written.pictures);
            require_written(writer.write(messages), file);
            messages.clear();
            waiting = 0;
        };
        for (StreamReader& stream : streams)
            stream.begin_segment(s);
        while (true) {
            // In the order of the file.
            StreamReader* first = nullptr;
            const RecordedFrame* frame = nullptr;
            for (StreamReader& stream : streams) {
                const RecordedFrame* const other = stream.upcoming(s);
                if (other && (!frame || other->payload_at < frame->payload_at)) {
                    frame = other;
                    first = &stream;
                }
            }
            if (!first)
                break;
            // The writer sorts the messages of one call by time.
            if (first->goes_back())
                flush();
            RecordedMessage message;
            // The arrival is set to the frame's time, so that the frame keeps its place.
            message.arrived = info.clock.session + (frame->time() - segment.origin);
            if (!first->take(recording, info.clock.session, message))
                continue;
            waiting += message.message->size();
            messages.push_back(std::move(message));
            if (waiting < batch_bytes)
                continue;
            flush();
            if (progress)
                progress(double(bytes_before + frame->payload_at) / double(recording.bytes()));
        }
        flush();
        require_written(writer.finish(), file);
        // It may be missing; then it is missing from the new recording as well.
        if (segment.next != 0)
            writer.name_next(segment.next);
        else if (s + 1 == recording.segments().size())
            note_lacks(writer, lacks_of(recording, result));
        check(draft, written);
        bytes_before += segment.bytes;
        result.bytes += writer.bytes();
        result.files.push_back(file.string());
    }
    if (!has_content(result))
        throw Error("Nothing in this recording can be saved: no picture of it is whole.");
    result.complete = saved_all(recording, lacks_of(recording, result));
    new_files.keep();
    return result;
}

}  // namespace theatron::record
