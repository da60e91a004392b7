// SPDX-License-Identifier: Apache-2.0
#include "send/color_watch.h"

#include <algorithm>
#include <thread>

#include "base/log.h"

namespace theatron::send {
namespace {

constexpr Duration measured_every = 1s;
// H.264 from a camera's JPEG, before it is measured: 10 ms of a core for 1280x720 (docs/codecs.md).
constexpr double seconds_per_pixel = 11e-9;

}  // namespace

ColorWatch::ColorWatch()
    : choice_(video::missing_color_encoder(video::parse_color_setting(auto_h264).setting)),
      reason_(choice_.reason()) {}

std::function<std::unique_ptr<video::ColorEncoder>(const video::ColorSetting&)>
ColorWatch::make_color(const JpegLimits& limits) const {
    return [is_h264 = is_h264(), limits](const video::ColorSetting& setting) {
        return setting.text == video::auto_color ? make_auto_encoder(is_h264, limits)
                                                 : video::make_color_encoder(setting);
    };
}

std::string ColorWatch::reason() const {
    const std::lock_guard lock(mutex_);
    return reason_;
}

ColorLoad ColorWatch::measure(const std::vector<const CameraLane*>& lanes) {
    ColorLoad load;
    load.busy = machine_.since_last();
    double cores = 0;
    for (const CameraLane* lane : lanes) {
        const auto& info = lane->info();
        double picture_s = double(info.calibration.color.size.area()) * seconds_per_pixel;
        load.lost += lane->dropped_newest();
        for (const EncoderFigures& encoder : lane->encoder_figures())
            if (encoder.codec == video::auto_color) {
                load.in_use = true;
                load.lost += encoder.left_out;
                if (*is_h264_ && encoder.cpu_ms > 0)
                    picture_s = encoder.cpu_ms / 1000;
            }
        cores += picture_s * info.frames_per_second;
    }
    load.h264 = cores / std::max(1u, std::thread::hardware_concurrency());
    return load;
}

void ColorWatch::on_tick(const std::vector<const CameraLane*>& lanes, TimePoint now) {
    if (now - measured_ < measured_every)
        return;
    const bool first = measured_ == TimePoint{};
    measured_ = now;
    const ColorLoad load = measure(lanes);
    if (first)
        return;  // nothing to compare with
    const bool changed = choice_.observe(load, now);
    *is_h264_ = choice_.is_h264();
    if (changed && load.in_use)
        log::info("send", "automatic colour changed", {{"to", choice_.reason()}});
    const std::lock_guard lock(mutex_);
    reason_ = choice_.reason();
}

}  // namespace theatron::send
