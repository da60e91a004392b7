// SPDX-License-Identifier: Apache-2.0
#include "client/color_preference.h"

#include <algorithm>
#include <cmath>

#include "phrases/phrase.h"
#include "video/color_codec.h"

namespace theatron::client {
namespace {

std::string whole(double value) {
    return std::to_string(std::lround(value));
}

std::string pictures_per_second(double value) {
    return say(std::lround(value) == 1 ? Phrase::picture_a_second : Phrase::pictures_a_second,
               whole(value));
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
      reason_(say(can_h264 ? Phrase::jpeg_unmeasured : Phrase::jpeg_without_h264)) {}

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
        reason_ = measure.is_thinned
                      ? say(Phrase::jpeg_is_late, pictures_per_second(measure.pictures_per_second))
                      : say(Phrase::jpeg_in_time);
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
    reason_ = say(Phrase::h264_is_tried, pictures_per_second(measure.pictures_per_second));
    began_.reset();
    is_judged_ = false;
    pictures_before_ = measure.pictures_per_second;
    failures_ = {};
}

void ColorPreference::judge(const ColorMeasure& measure, TimePoint now) {
    if (failures_.are_too_many(measure.lost, now))
        return end(say(Phrase::h264_failed), now);
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
        return end(say(Phrase::h264_is_slow, whole(measure.decode_ms)), now);
    if (now - *began_ >= longest_pause)
        pause_ = first_pause;
    if (is_judged_ || now - *began_ < trial)
        return;
    is_judged_ = true;
    const std::string pictures = pictures_per_second(measure.pictures_per_second),
                      before = whole(pictures_before_);
    if (measure.pictures_per_second < enough * pictures_before_)
        return end(say(Phrase::h264_is_no_better, pictures, before), now);
    reason_ = say(Phrase::h264_is_used, pictures, before);
}

void ColorPreference::end(const std::string& why, TimePoint now) {
    asks_h264_ = false;
    codec_ = video::ColorSetting().text;
    not_before_ = now + pause_;
    last_whole_ = now;
    reason_ = say(Phrase::jpeg_for_now, why, whole(to_seconds(pause_)));
    pause_ = std::min(2 * pause_, longest_pause);
}

}  // namespace theatron::client
