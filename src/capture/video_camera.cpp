// SPDX-License-Identifier: Apache-2.0
#include "capture/video_camera.h"

#include <filesystem>

#include "base/lasting_error.h"
#include "capture/playback.h"
#include "capture/source_camera.h"
#include "capture/video_recording.h"
#include "geometry/screen.h"

namespace theatron::capture {

std::unique_ptr<Camera> open_video_camera(Options& options, const Progress&) {
    const PlaybackOptions playback = take_playback_options(options);
    const double width_m = options.take_number("width", usual_screen_width_m, least_screen_width_m,
                                               largest_screen_width_m);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("A shared video needs a file, as in video:FILE.");
    const std::filesystem::path path = options.value();
    auto video = std::make_unique<VideoRecording>(path);
    (void)video->offset();  // throws if there is no picture
    CameraInfo info;
    info.name = path.stem().string();
    info.calibration = screen_calibration(video->size(), width_m, usual_screen_place);
    info.calibration.registered = false;
    info.frames_per_second = video->frames_per_second();
    return make_recorded_camera(std::move(info), std::move(video), playback);
}

std::string camera_of_shared(const std::string& source) {
    const std::string kind = Options::parse(source).kind();
    const bool is_live = source.find(':') != std::string::npos &&
                         (kind == "x11" || kind == "v4l2" || kind == "rtsp");
    return is_live ? source : "video:" + source;
}

}  // namespace theatron::capture
