// SPDX-License-Identifier: Apache-2.0
#include "session/camera_streams.h"

#include <algorithm>

#include "geometry/calibration.h"
#include "session/delivery.h"

namespace theatron::session {
namespace {

constexpr Duration longest_made_in = std::chrono::milliseconds(100);

}  // namespace

CameraStreams::CameraStreams(wire::Camera description, SettingNumbers& numbers, const Usual& usual,
                             const CodecSteps& codecs)
    : offered_as_(description.kind),
      description_(std::move(description)),
      depth_(numbers, usual.depth,
             [&codecs](const std::string& codec) { return depth_traits(codec, codecs); }),
      color_(numbers, usual.color),
      refers_(codecs.refers) {
    if (is_shown_screen())
        description_.kind = wire::CameraKind::room;
    if (const auto calibration = decode_calibration(description_.calibration)) {
        registered_ = calibration->room_from_camera;
        has_own_gain_ = calibration->color_gain.has_value();
        sees_person_ = calibration->person != 0;
    }
}

void CameraStreams::set_calibration(const Bytes& calibration) {
    description_.calibration = calibration;
    if (const auto decoded = decode_calibration(calibration)) {
        registered_ = decoded->room_from_camera;
        has_own_gain_ = decoded->color_gain.has_value();
    }
    adjust(adjustment_);
}

bool CameraStreams::set_estimated_gain(Vec3 gain) {
    estimated_gain_ = gain;
    const Bytes before = description_.calibration;
    adjust(adjustment_);
    return description_.calibration != before;
}

void CameraStreams::adjust(const CameraAdjustment& adjustment) {
    adjustment_ = rounded(adjustment);
    description_.adjustment = encode_adjustment(adjustment_);
    auto calibration = decode_calibration(description_.calibration);
    if (!calibration)
        return;
    calibration->room_from_camera =
        adjustment_.is_nudged() ? nudged(registered_, adjustment_) : registered_;
    if (estimated_gain_ && !has_own_gain_)
        calibration->color_gain = estimated_gain_;
    description_.calibration = encode_calibration(*calibration);
}

std::optional<std::vector<SettingId>> CameraStreams::take_change() {
    std::vector<SettingId> gone;
    bool changed = false;
    for (const bool depth : {true, false}) {
        std::vector<ActiveSetting>& known = depth ? known_depth_ : known_color_;
        const std::vector<ActiveSetting>& active = table(depth).active();
        if (known == active)
            continue;
        changed = true;
        for (const ActiveSetting& old : known)
            if (std::find(active.begin(), active.end(), old) == active.end())
                gone.push_back(old.id);
        known = active;
    }
    if (!changed)
        return std::nullopt;
    for (const SettingId setting : gone) {
        slow_.erase(setting);
        made_in_.erase(setting);
        newest_depth_.erase(setting);
    }
    return gone;
}

bool CameraStreams::set_slow(bool depth, SettingId setting, bool is_slow) {
    const bool is_new = is_slow ? slow_.insert(setting).second : slow_.erase(setting) > 0;
    if (is_new)
        table(depth).set_slow(setting, is_slow);
    return is_new;
}

bool CameraStreams::is_slow(bool depth, const std::string& codec) const {
    const auto& active = table(depth).active();
    return std::any_of(active.begin(), active.end(), [&](const ActiveSetting& s) {
        return s.codec == codec && slow_.contains(s.id);
    });
}

std::optional<int> CameraStreams::on_media(const wire::MediaHeader& header, TimePoint now) {
    const bool depth = is_depth(header.stream);
    const ActiveSetting* setting = table(depth).find(header.setting);
    if (!setting)
        return std::nullopt;
    // A frame that is sent again, or of a camera that lags, is old for other reasons: limited.
    const Duration age = std::clamp(now - header.captured, Duration(0), longest_made_in);
    Duration& made_in = made_in_[header.setting];
    made_in += (age - made_in) / 16;

    int layer = std::min(int(header.temporal_layer), served_layers - 1);
    if (depth) {
        if (setting->traits.independent)
            layer = layer_by_number(header.frame);
        newest_depth_[header.setting] = {header.frame, layer};
    } else {
        color_.note_chain(header.setting, refers_ && refers_(header.codec));
    }
    return layer;
}

int CameraStreams::color_layer(FrameNumber frame, SettingId depth) const {
    const auto found = newest_depth_.find(depth);
    if (found == newest_depth_.end() || found->second.frame != frame)
        return layer_by_number(frame);
    return found->second.layer;
}

Duration CameraStreams::made_in(SettingId setting) const {
    const auto found = made_in_.find(setting);
    return found == made_in_.end() ? Duration(0) : found->second;
}

}  // namespace theatron::session
