// SPDX-License-Identifier: Apache-2.0
#include "record/recording_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "record/matroska_reader.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

constexpr double usual_frames_per_second = 30;
constexpr std::size_t max_filters = 4096;  // bytes of a line

// What was written in nanoseconds is known to a thousandth of a frame.
double frames_per_second(std::uint64_t default_duration_ns) {
    constexpr std::uint64_t shortest = 1'000'000, longest = 60'000'000'000;
    if (default_duration_ns < shortest || default_duration_ns > longest)
        return usual_frames_per_second;
    return std::round(1e12 / double(default_duration_ns)) / 1000;
}

std::string text_of(const Bytes& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

Result<std::unique_ptr<RecordingFile>> RecordingFile::read(std::unique_ptr<ByteSource> source) {
    Result<FoundFile> found = read_matroska(*source);
    if (!found)
        return found.error();
    std::unique_ptr<RecordingFile> recording(new RecordingFile(std::move(source)));
    recording->complete_ = found->complete;

    std::map<CameraId, CameraContent> cameras;
    for (const FoundTrack& track : found->tracks) {
        if (track.number < 1)
            continue;
        const StreamId id = stream_of_track(track.number);
        const bool is_jpeg = track.codec_id == jpeg_codec_id;
        if (is_depth(id) ? track.codec_id != depth_codec_id
                         : !is_jpeg && track.codec_id != color_codec_id)
            continue;
        CameraContent& camera = cameras[camera_of(id)];
        camera.id = camera_of(id);
        camera.name = track.name;
        camera.frames_per_second = frames_per_second(track.default_duration_ns);
        StreamContent& stream = is_depth(id) ? camera.depth : camera.color;
        stream.present = true;
        stream.codec = is_jpeg ? "jpeg" : text_of(track.codec_private);
        stream.width = track.width;
        stream.height = track.height;
    }
    std::erase_if(cameras, [](const auto& entry) { return !entry.second.depth.present; });
    if (cameras.empty())
        return Status::unsupported;
    for (FoundAttachment& attachment : found->attachments)
        for (auto& [id, camera] : cameras)
            if (attachment.name == calibration_name(id))
                camera.calibration = std::move(attachment.bytes);

    bool first = true;
    for (const FoundBlock& block : found->blocks) {
        const StreamId id = stream_of_track(block.track);
        const auto camera = cameras.find(camera_of(id));
        if (camera == cameras.end())
            continue;
        StreamContent& stream = is_depth(id) ? camera->second.depth : camera->second.color;
        std::array<std::byte, wire::media_header_size> bytes;
        if (!stream.present || block.side_size != bytes.size() ||
            !recording->source_->read(block.side_at, bytes)) {
            ++recording->refused_;
            continue;
        }
        const auto header = wire::parse_header_alone(bytes);
        if (!header || header->stream != id || header->payload_size != block.payload_size ||
            header->slices != 1) {
            ++recording->refused_;
            continue;
        }
        recording->begin_ =
            first ? header->captured : std::min(recording->begin_, header->captured);
        recording->end_ = first ? header->captured : std::max(recording->end_, header->captured);
        first = false;
        if (is_depth(id) && block.note_size > 0 && block.note_size <= max_filters) {
            Bytes note(block.note_size);
            if (recording->source_->read(block.note_at, note)) {
                std::string filters = text_of(note);
                if (filters == no_filters)
                    filters.clear();
                stream.filters.push_back({stream.frames.size(), std::move(filters)});
            }
        }
        stream.frames.push_back({*header, block.payload_at});
    }
    for (auto& [id, camera] : cameras)
        recording->cameras_.push_back(std::move(camera));
    return recording;
}

std::unique_ptr<RecordingFile> RecordingFile::open(const std::filesystem::path& path) {
    auto recording = read(open_file_source(path));
    if (recording)
        return std::move(*recording);
    const std::string name = "'" + path.string() + "'";
    switch (recording.error()) {
        case Status::malformed:
            throw Error(name + " is not a recording: it is no Matroska file.");
        case Status::truncated:
            throw Error(name + " ends before its first frame.");
        case Status::unsupported:
            throw Error(name +
                        " is a Matroska file, but not one that Theatron recorded; for an Azure "
                        "Kinect's recording, use mkv:FILE.");
        default:
            throw Error(name + " cannot be read as a recording: it is " +
                        std::string(to_text(recording.error())) + ".");
    }
}

Status RecordingFile::read_payload(const RecordedFrame& frame, Bytes& out) const {
    out.resize(frame.header.payload_size);
    return source_->read(frame.payload_at, out) ? Status::ok : Status::truncated;
}

}  // namespace theatron::record
