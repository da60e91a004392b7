// SPDX-License-Identifier: Apache-2.0
#include "export/verify_recording.h"

#include <algorithm>

#include "capture/recording_camera.h"
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

// Decodes the camera's pictures of one calibration.
void decode_all(capture::RecordedFrames& camera, Minutes& minutes,
                const std::function<void()>& picture_done) {
    video::JpegDecompressor jpeg;
    ColorImage color;
    Frame frame;
    capture::PictureLosses before;
    while (true) {
        const auto offset = camera.offset();
        VerifiedMinute& minute = minutes[offset            ? minute_of(*offset)
                                         : minutes.empty() ? 0
                                                           : minutes.rbegin()->first];
        if (offset) {
            camera.read(frame);
            ++minute.depth.pictures;
            if (frame.color.is_jpeg() && jpeg.decompress(frame.color.jpeg, color) != Status::ok)
                ++minute.color.damaged;
            else
                minute.color.pictures += !frame.color.empty();
        }
        const capture::PictureLosses& losses = camera.losses();
        minute.depth.damaged += losses.damaged_depth - before.damaged_depth;
        minute.depth.undecodable += losses.undecodable_depth - before.undecodable_depth;
        minute.color.damaged += losses.damaged_color - before.damaged_color;
        minute.color.undecodable += losses.undecodable_color - before.undecodable_color;
        before = losses;
        if (!offset)
            return;
        picture_done();
    }
}

}  // namespace

std::uint64_t frames_between(const record::RecordedFrame& before,
                             const record::RecordedFrame& frame) {
    const auto step = std::int32_t(frame.number - before.number);
    return frame.segment == before.segment && step > 1 ? std::uint64_t(step - 1) : 0;
}

Verification verify(const std::shared_ptr<const record::RecordingFile>& recording,
                    const std::string& file, const capture::Progress& progress) {
    Verification found;
    found.damaged = !recording->intact();
    std::size_t all = 0, done = 0;
    for (const record::CameraContent& camera : recording->cameras())
        all += camera.depth.frames.size();
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
            decode_all(frames, minutes, picture_done);
        }
        for (const auto& [minute, pictures] : minutes)
            for (const VerifiedPictures& p : {pictures.depth, pictures.color})
                found.damaged |= p.damaged > 0 || p.undecodable > 0;
    }
    return found;
}

}  // namespace theatron::exporting
