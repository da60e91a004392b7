// SPDX-License-Identifier: Apache-2.0
#include "export/verify_recording.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/frame_order.h"
#include "capture/recording_camera.h"
#include "video/color_codec.h"
#include "video/jpeg_native.h"

namespace theatron::exporting {
namespace {

using Minutes = std::map<int, VerifiedMinute>;

int minute_of(Duration time) {
    return int(std::chrono::duration_cast<std::chrono::minutes>(time).count());
}

// Counts missing pictures from the index alone.
void count_gaps(const record::StreamContent& stream, double frames_per_second,
                VerifiedPictures VerifiedMinute::*kind, Minutes& minutes) {
    for (std::size_t i = 1; i < stream.frames.size(); ++i) {
        const record::RecordedFrame &before = stream.frames[i - 1], &frame = stream.frames[i];
        const std::uint64_t missing = frames_between(before, frame);
        const bool gap = to_seconds(frame.time() - before.time()) > 1.5 / frames_per_second;
        if (missing == 0 && !gap)
            continue;
        VerifiedPictures& minute = minutes[minute_of(frame.time())].*kind;
        minute.missing += missing;
        minute.gaps += gap;
    }
}

// Decodes the camera's depth of one calibration.
void decode_depth(capture::RecordedFrames& camera, Minutes& minutes,
                  const std::function<void()>& picture_done) {
    capture::PictureLosses before;
    while (true) {
        const auto offset = camera.offset();
        VerifiedPictures& minute = minutes[offset            ? minute_of(*offset)
                                           : minutes.empty() ? 0
                                                             : minutes.rbegin()->first]
                                       .depth;
        const capture::PictureLosses& losses = camera.losses();
        minute.damaged += losses.damaged_depth - before.damaged_depth;
        minute.undecodable += losses.undecodable_depth - before.undecodable_depth;
        before = losses;
        if (!offset)
            return;
        ++minute.pictures;
        camera.skip();
        picture_done();
    }
}

// Decoders of a camera's colour in one of its parts.
class ColorCheck {
public:
    explicit ColorCheck(const record::CameraPart& part)
        : size_{part.color.width, part.color.height} {
        if (part.color.codec.starts_with("jpeg"))
            return;
        const auto parsed = video::parse_color_setting(part.color.codec);
        if (!parsed.problem.empty())
            throw Error("The colour is encoded in a way that this Theatron does not know: " +
                        parsed.problem);
        decoder_ = video::make_color_decoder(parsed.setting.id);
    }

    // missing_reference: the frame is whole, but its reference is not.
    Status decode(const wire::MediaHeader& header, ByteView payload) {
        if (!decoder_) {
            const Status status = jpeg_.decompress(payload, image_);
            return status == Status::ok && image_.size != size_ ? Status::size_mismatch : status;
        }
        // A frame that is no key frame refers to the previous one, and so on up to a key frame.
        if (!header.key && last_ != header.reference)
            return Status::missing_reference;
        last_.reset();
        Status status = decoder_->submit(payload, header.frame);
        if (status != Status::ok)
            return status;
        last_ = header.frame;
        status = Status::malformed;
        while (auto decoded = decoder_->poll()) {
            status = decoded->image.size == size_ ? Status::ok : Status::size_mismatch;
            decoder_->recycle(std::move(decoded->image));
        }
        return status;
    }

private:
    Size size_;
    std::unique_ptr<video::ColorDecoder> decoder_;  // null: JPEG
    std::optional<FrameNumber> last_;               // that it decoded
    video::JpegDecompressor jpeg_;
    ColorImage image_;
};

// Decodes all colour of a camera, whatever depth there is.
void decode_color(const record::RecordingFile& recording, const record::CameraContent& camera,
                  Minutes& minutes, const std::function<void()>& picture_done) {
    std::optional<ColorCheck> check;
    const record::CameraPart* part = nullptr;
    Bytes payload;
    for (const record::RecordedFrame& frame : camera.color.frames) {
        if (!part || part->segment != frame.segment) {
            part = &*std::find_if(camera.parts.begin(), camera.parts.end(),
                                  [&](const auto& p) { return p.segment == frame.segment; });
            check.emplace(*part);
        }
        const auto header = recording.read_header(frame);
        Status status = header ? recording.read_payload(frame, payload) : header.error();
        if (status == Status::ok)
            status = check->decode(*header, payload);
        VerifiedPictures& minute = minutes[minute_of(frame.time())].color;
        minute.pictures += status == Status::ok;
        minute.undecodable += status == Status::missing_reference;
        minute.damaged += status != Status::ok && status != Status::missing_reference;
        picture_done();
    }
}

}  // namespace

std::uint64_t frames_between(const record::RecordedFrame& before,
                             const record::RecordedFrame& frame) {
    const auto step = frames_after(frame.number, before.number);
    return frame.segment == before.segment && step > 1 ? std::uint64_t(step - 1) : 0;
}

Verification verify(const std::shared_ptr<const record::RecordingFile>& recording,
                    const std::string& file, const capture::Progress& progress) {
    Verification found;
    for (const record::Segment& segment : recording->segments())
        found.damaged_pictures |= segment.damaged_places > 0 || segment.refused > 0;
    std::size_t all = 0, done = 0;
    for (const record::CameraContent& camera : recording->cameras())
        all += camera.depth.frames.size() + camera.color.frames.size();
    const auto picture_done = [&] {
        if (++done % 16 == 0 && progress)
            progress("verifying", double(done) / double(all));
    };
    for (std::size_t i = 0; i < recording->cameras().size(); ++i) {
        const record::CameraContent& content = recording->cameras()[i];
        Minutes& minutes = found.cameras.emplace_back();
        count_gaps(content.depth, content.frames_per_second, &VerifiedMinute::depth, minutes);
        count_gaps(content.color, content.frames_per_second, &VerifiedMinute::color, minutes);
        for (std::size_t n = 0; n < capture::calibrations_of(content); ++n) {
            capture::RecordedFrames frames(recording, i, file, n);
            decode_depth(frames, minutes, picture_done);
        }
        decode_color(*recording, content, minutes, picture_done);
        for (const auto& [minute, pictures] : minutes)
            for (const VerifiedPictures& p : {pictures.depth, pictures.color})
                found.damaged_pictures |= p.damaged > 0 || p.undecodable > 0;
    }
    found.damaged = found.damaged_pictures || !recording->intact();
    return found;
}

}  // namespace theatron::exporting
