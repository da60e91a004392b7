// SPDX-License-Identifier: Apache-2.0
#include "viewer/view_choice.h"

#include <charconv>

#include "base/error.h"
#include "base/options.h"
#include "phrases/phrase.h"

namespace theatron::viewer {

ViewChoice parse_view(const std::string& text) {
    Options options = Options::parse(text);
    ViewChoice choice;
    choice.yaw_degrees = options.take_number("yaw", 0, -180, 180);
    choice.pitch_degrees = options.take_number("pitch", 0, -80, 80);
    options.require_no_problem();
    const std::string& number = options.value();
    int camera = -1;
    const auto parsed = std::from_chars(number.data(), number.data() + number.size(), camera);
    if (options.kind() != "camera" || parsed.ec != std::errc{} ||
        parsed.ptr != number.data() + number.size() || camera < 0 || camera > 999)
        throw Error("The view '" + text +
                    "' is not understood; write camera:0 or camera:0,yaw=20,pitch=10.");
    choice.camera = CameraId(camera);
    return choice;
}

render::CameraView ViewChoice::resolve(const std::map<CameraId, Calibration>& calibrations,
                                       const std::map<CameraId, receive::CameraFramePtr>& newest,
                                       Size picture) const {
    const auto calibration = calibrations.find(camera);
    const auto frame = newest.find(camera);
    if (calibration == calibrations.end())
        throw Error(say(Phrase::no_such_camera, std::to_string(int(camera)),
                        std::to_string(calibrations.size())));
    if (frame == newest.end())
        throw Error(say(Phrase::camera_sent_nothing, std::to_string(int(camera))));
    const render::CameraView own = render::view_of_camera(
        calibration->second.depth, calibration->second.room_from_camera, picture);
    const Vec3 pivot = render::point_of_interest(calibration->second, frame->second->depth.view());
    return render::orbited(own, pivot, yaw_degrees, pitch_degrees);
}

}  // namespace theatron::viewer
