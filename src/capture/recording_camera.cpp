// SPDX-License-Identifier: Apache-2.0
#include "capture/recording_camera.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "video/depth_codecs.h"
#include "video/jpeg_header.h"

namespace theatron::capture {

RecordedFrames::RecordedFrames(std::shared_ptr<const record::RecordingFile> recording,
                               std::size_t camera, std::string file)
    : recording_(std::move(recording)),
      content_(recording_->cameras()[std::min(camera, recording_->cameras().size() - 1)]),
      file_(std::move(file)) {
    const std::string name = "'" + file_ + "'";
    if (const std::size_t count = recording_->cameras().size(); camera >= count)
        throw Error(name + " holds " + std::to_string(count) +
                    (count == 1 ? " camera" : " cameras") +
                    ", numbered from 0, so camera=" + std::to_string(camera) + " is none of them.");
    const auto calibration = decode_calibration(content_.calibration);
    if (!calibration)
        throw Error("The calibration in " + name + " is " +
                    std::string(theatron::to_text(calibration.error())) + ".");
    info_ = {content_.name, *calibration, content_.frames_per_second};

    const auto depth = video::parse_depth_setting(content_.depth.codec);
    if (!depth.problem.empty())
        throw Error("The depth in " + name +
                    " is encoded in a way that this Theatron does not know: " + depth.problem);
    setting_ = depth.setting;
    if (content_.color.present && !content_.color.codec.starts_with("jpeg")) {
        const auto color = video::parse_color_setting(content_.color.codec);
        if (!color.problem.empty())
            throw Error("The colour in " + name +
                        " is encoded in a way that this Theatron does not know: " + color.problem);
        color_ = video::make_color_decoder(color.setting.id);
    }
    temporal_ = std::any_of(content_.depth.frames.begin(), content_.depth.frames.end(),
                            [](const record::RecordedFrame& f) { return !f.header.key; });
    // A camera's number starts anew with its host, so the time belongs to a frame's name.
    using Name = std::pair<TimePoint, FrameNumber>;
    std::map<Name, std::size_t> colors;
    bool decodable = false;
    for (std::size_t i = 0; i < content_.color.frames.size(); ++i) {
        const wire::MediaHeader& h = content_.color.frames[i].header;
        // One that is no key frame refers to the one before it, and so on to a key frame.
        decodable =
            h.key || (decodable && content_.color.frames[i - 1].header.frame == h.reference);
        if (decodable)
            colors[{h.captured, h.frame}] = i;
    }
    for (const record::RecordedFrame& f : content_.depth.frames) {
        const auto same = colors.find({f.header.captured, f.header.frame});
        colors_.push_back(same == colors.end() ? std::nullopt : std::optional(same->second));
    }
    rewind();
}

void RecordedFrames::rewind() {
    depth_ = std::make_unique<codec::DepthStreamDecoder>(video::make_depth_decoder(setting_));
    next_ = next_color_ = 0;
    is_decoded_ = false;
    last_offset_ = {};
}

std::optional<Duration> RecordedFrames::offset() {
    for (; next_ < content_.depth.frames.size(); ++next_) {
        const wire::MediaHeader& header = upcoming().header;
        if (!is_decoded_ && !header.key && !decode())
            continue;
        // From the beginning of the whole recording, so that its cameras stay in step.
        last_offset_ = std::max(last_offset_, header.captured - recording_->begin());
        return last_offset_;
    }
    return std::nullopt;
}

std::optional<Duration> RecordedFrames::round() const {
    return recording_->end() - recording_->begin() +
           seconds_to_duration(1 / info_.frames_per_second);
}

bool RecordedFrames::decode() {
    const record::RecordedFrame& frame = upcoming();
    const wire::MediaHeader& header = frame.header;
    if (const Status status = recording_->read_payload(frame, payload_); status != Status::ok)
        refuse("depth", header.frame, status);
    const auto size = depth_->read_size(payload_);
    if (!size)
        refuse("depth", header.frame, size.error());
    if (*size != info_.calibration.depth.size)
        refuse("depth", header.frame, Status::size_mismatch);
    decoded_.resize(*size);
    const Status status =
        depth_->decode({header.frame, header.reference, header.temporal_layer, header.key},
                       payload_, decoded_.view());
    if (status == Status::missing_reference)
        return false;
    if (status != Status::ok)
        refuse("depth", header.frame, status);
    is_decoded_ = true;
    return true;
}

void RecordedFrames::skip() {
    if (temporal_ && !is_decoded_)
        decode();
    is_decoded_ = false;
    ++next_;
}

void RecordedFrames::read(Frame& out) {
    if (!is_decoded_ && !decode())
        refuse("depth", upcoming().header.frame, Status::missing_reference);
    is_decoded_ = false;
    std::swap(out.depth, decoded_);

    out.color.jpeg.clear();
    out.color.pixels.pixels.clear();
    out.color.size = {};
    if (const auto color = colors_[next_++])
        read_color(*color, out.color);
}

void RecordedFrames::read_color(std::size_t index, ColorData& out) {
    const record::RecordedFrame& frame = content_.color.frames[index];
    const FrameNumber number = frame.header.frame;
    if (color_) {
        decode_color(index, out);
    } else {
        if (const Status status = recording_->read_payload(frame, payload_); status != Status::ok)
            refuse("colour", number, status);
        const auto size = video::read_jpeg_size(payload_);
        if (!size)
            refuse("colour", number, size.error());
        out.size = *size;
        out.jpeg.assign(payload_.begin(), payload_.end());
    }
    if (!out.empty() && out.size != info_.calibration.color.size)
        refuse("colour", number, Status::size_mismatch);
}

// Decodes the picture, and those before it that it refers to and that were passed over.
void RecordedFrames::decode_color(std::size_t index, ColorData& out) {
    const auto& frames = content_.color.frames;
    std::size_t first = index;
    while (!frames[first].header.key && first != next_color_)
        --first;
    next_color_ = index + 1;
    for (std::size_t i = first; i <= index; ++i) {
        const FrameNumber number = frames[i].header.frame;
        Status status = recording_->read_payload(frames[i], payload_);
        if (status == Status::ok)
            status = color_->submit(payload_, number);
        if (status != Status::ok)
            refuse("colour", number, status);
        while (auto decoded = color_->poll()) {
            std::swap(out.pixels, decoded->image);
            out.size = out.pixels.size;
            color_->recycle(std::move(decoded->image));
        }
    }
}

void RecordedFrames::refuse(const char* what, FrameNumber number, Status why) const {
    throw Error("The " + std::string(what) + " picture of frame " + std::to_string(number) +
                " in '" + file_ + "' is " + std::string(theatron::to_text(why)) + ".");
}

std::unique_ptr<Camera> open_recording_camera(Options& options, const Progress& progress) {
    const int camera = options.take_int("camera", 0, 0, 1000);
    const PlaybackOptions playback = take_playback_options(options);
    options.require_no_problem();
    if (options.value().empty())
        throw Error("The camera 'recording' needs a file, as in recording:FILE.mkv.");
    const std::string& file = options.value();
    auto frames = std::make_unique<RecordedFrames>(record::RecordingFile::open(file),
                                                   std::size_t(camera), file);
    if (frames->frames() == 0)
        throw Error("'" + file + "' holds no frame of camera " + std::to_string(camera) + ".");
    if (std::size_t(playback.start) >= frames->frames())
        throw Error("'" + file + "' has " + std::to_string(frames->frames()) +
                    " frames, so start=" + std::to_string(playback.start) + " is too far.");
    CameraInfo info = frames->info();
    std::unique_ptr<Recording> recording = std::move(frames);
    // Decoding costs little: memory is taken only where that is asked for.
    if (playback.preload.value_or(false)) {
        auto& source = static_cast<RecordedFrames&>(*recording);
        recording = std::make_unique<MemoryRecording>(source, source.frames(), progress);
    }
    return make_recorded_camera(std::move(info), std::move(recording), playback);
}

}  // namespace theatron::capture
