// SPDX-License-Identifier: Apache-2.0
#include "page_color.h"

#include <algorithm>
#include <tuple>

#include "phrases/phrase.h"
#include "video/color_codec.h"

namespace theatron::web {
namespace {

bool is_h264(const std::string& codec) {
    return codec.find("h264") != std::string::npos;
}

client::ColorMeasure measure_of(const client::ParticipantFigures& figures) {
    client::ColorMeasure measure;
    measure.is_thinned = figures.status.delivery.level > 0;
    std::optional<double> slowest;
    for (const client::CameraFigures& one : figures.cameras) {
        const auto& [camera, color] = std::tie(one.camera, one.color);
        // Faces come in codecs of their own.
        if (!camera.description.has_color || camera.description.kind == wire::CameraKind::face)
            continue;
        measure.has_h264 = measure.has_h264 || is_h264(color.codec);
        measure.decode_ms = std::max(measure.decode_ms, color.decode_ms);
        measure.lost += color.decoder_failures;
        if (camera.state.condition == wire::CameraCondition::live)
            slowest = std::min(slowest.value_or(color.frames_per_second), color.frames_per_second);
    }
    measure.pictures_per_second = slowest.value_or(0);
    return measure;
}

}  // namespace

PageColor::PageColor(const std::string& wish, bool can_h264)
    : can_h264_(can_h264), preference_(can_h264) {
    if (wish.empty() || wish == video::auto_color)
        return;
    const auto parsed = video::parse_color_setting(wish);
    if (parsed.problem.empty())
        choose(parsed.setting.text);
    else
        reason_ = say(Phrase::jpeg_because, parsed.problem);
}

const std::string& PageColor::codec() const {
    return chosen_.empty() ? preference_.codec() : chosen_;
}

const std::string& PageColor::reason() const {
    return reason_.empty() ? preference_.reason() : reason_;
}

void PageColor::choose(const std::string& codec) {
    if (codec == video::auto_color) {
        chosen_.clear();
        reason_.clear();
        return;
    }
    if (is_h264(codec) && !can_h264_) {
        chosen_.clear();
        reason_ = say(Phrase::jpeg_without_h264);
        return;
    }
    chosen_ = codec;
    reason_ = say(Phrase::codec_as_chosen, codec);
    failures_ = {};
}

bool PageColor::observe(const client::ParticipantFigures& figures, TimePoint now) {
    const client::ColorMeasure measure = measure_of(figures);
    if (chosen_.empty()) {
        if (!preference_.observe(measure, now))
            return false;
        reason_.clear();
        return true;
    }
    if (!is_h264(chosen_) || !failures_.are_too_many(measure.lost, now))
        return false;
    choose(video::ColorSetting().text);
    reason_ = say(Phrase::jpeg_because, say(Phrase::h264_failed));
    return true;
}

void PageColor::add_to(nlohmann::json& state) const {
    state["color"] = {{"asked", codec()}, {"is_chosen", !chosen_.empty()}, {"reason", reason()}};
    state["overlay"]["facts"].push_back(
        {{"label", say(Phrase::choice_of_color)}, {"value", reason()}, {"warning", false}});
}

}  // namespace theatron::web
