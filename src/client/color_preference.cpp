// SPDX-License-Identifier: Apache-2.0
#include "client/color_preference.h"

#include <algorithm>
#include <cmath>

#include "video/color_codec.h"

namespace theatron::client {
namespace {

std::string whole(double value) {
    return std::to_string(std::lround(value));
}

std::string pictures_per_second(double value) {
    return whole(value) + (std::lround(value) == 1 ? " picture" : " pictures") + " a second";
}

}  // namespace

bool DecoderFailures::are_too_many(std::uint64_t lost, TimePoint now) {
    if (lost_ && lost > *lost_)
        failures_.push_back(now);
    lost_ = lost;
    while (!failures_.empty() && now - failures_.front() > window)
        failures_.pop_front();
    return failures_.size() >= most;
}

ColorPreference::ColorPreference(bool can_h264)
    : can_h264_(can_h264),
      codec_(video::ColorSetting().text),
      reason_(can_h264 ? "JPEG: nothing is measured yet"
                       : "JPEG: this browser does not decode H.264") {}

bool ColorPreference::observe(const ColorMeasure& measure, TimePoint now) {
    if (!can_h264_)
        return false;
    if (last_call_ && now - *last_call_ > standstill) {
        last_whole_ = now;
        began_.reset();
    }
    last_call_ = now;
    if (asks_h264_) {
        judge(measure, now);
        return !asks_h264_;
    }
    if (!has_tried_ && measure.pictures_per_second > 0)
        reason_ = !measure.is_thinned
                      ? "JPEG: all pictures come in time"
                      : "JPEG: only " + pictures_per_second(measure.pictures_per_second) +
                            " come; H.264 is tried if that lasts";
    if (!measure.is_thinned || !last_whole_)
        last_whole_ = now;
    if (now - *last_whole_ < patience || now < not_before_)
        return false;
    begin(measure);
    return true;
}

void ColorPreference::begin(const ColorMeasure& measure) {
    asks_h264_ = has_tried_ = true;
    codec_ = video::parse_color_setting("h264").setting.text;
    reason_ = "H.264 is tried: only " + pictures_per_second(measure.pictures_per_second) +
              " came as JPEG";
    began_.reset();
    is_judged_ = false;
    pictures_before_ = measure.pictures_per_second;
    failures_ = {};
}

void ColorPreference::judge(const ColorMeasure& measure, TimePoint now) {
    if (failures_.are_too_many(measure.lost, now))
        return end("the browser's decoder failed with H.264", now);
    if (!measure.has_h264) {
        began_.reset();
        return;
    }
    if (!began_) {
        began_ = last_fast_ = now;
        return;
    }
    if (measure.decode_ms <= slow_decode_ms)
        last_fast_ = now;
    if (now - last_fast_ >= patience)
        return end("the browser took " + whole(measure.decode_ms) + " ms for a picture in H.264",
                   now);
    if (now - *began_ >= longest_pause)
        pause_ = first_pause;
    if (is_judged_ || now - *began_ < trial)
        return;
    is_judged_ = true;
    const std::string pictures = pictures_per_second(measure.pictures_per_second),
                      before = whole(pictures_before_);
    if (measure.pictures_per_second < enough * pictures_before_)
        return end(pictures + " came as H.264, " + before + " before", now);
    reason_ = "H.264: " + pictures + ", " + before + " as JPEG";
}

void ColorPreference::end(const std::string& why, TimePoint now) {
    asks_h264_ = false;
    codec_ = video::ColorSetting().text;
    not_before_ = now + pause_;
    last_whole_ = now;
    reason_ = "JPEG: " + why + "; H.264 is tried again after " + whole(to_seconds(pause_)) + " s";
    pause_ = std::min(2 * pause_, longest_pause);
}

}  // namespace theatron::client
