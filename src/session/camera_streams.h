// SPDX-License-Identifier: Apache-2.0
// One camera of a session: its publisher, the settings in which it is encoded, and the setting that
// each receiver gets. A pure state machine.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/time.h"
#include "session/camera_adjustment.h"
#include "session/setting_table.h"
#include "session/stream_rates.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::session {

class CameraStreams {
public:
    struct Usual {
        std::string depth, color;  // codecs with a reserved place; see SettingTable
    };
    // `numbers` must outlive the camera.
    CameraStreams(wire::Camera description, SettingNumbers& numbers, const Usual& usual,
                  const CodecSteps& codecs);

    // With the adjusted calibration.
    const wire::Camera& description() const { return description_; }
    const CameraAdjustment& adjustment() const { return adjustment_; }
    const Pose& registered() const { return registered_; }
    // The camera is registered anew, with the same lenses.
    void set_calibration(const Bytes& calibration);
    // Within its limits.
    void adjust(const CameraAdjustment& adjustment);
    // Factors of colours that were estimated (geometry/color_balance.h), also for calibrations to
    // come. One that has gains of its own keeps those. True if the description changed.
    bool set_estimated_gain(Vec3 gain);
    ParticipantId publisher() const { return description_.publisher; }
    bool is_face() const { return description_.kind == wire::CameraKind::face; }
    // A screen that came as wire::CameraKind::screen, of which others are told as of any screen.
    bool is_shown_screen() const { return offered_as_ == wire::CameraKind::screen; }
    // Its publisher encodes it in one way alone, whatever its receivers wish.
    bool has_one_encoding() const { return is_face() || is_shown_screen(); }
    // On it depends the right that its publisher needs.
    wire::CameraKind offered_as() const { return offered_as_; }
    // Nobody is told of its own camera, and of faces only programs that show them.
    bool is_told_to(ParticipantId receiver, bool takes_faces) const {
        return publisher() != receiver && (takes_faces || !is_face());
    }
    // A recorder gets only cameras that may be recorded.
    bool is_for(ParticipantId receiver, bool takes_faces, bool records) const {
        return is_told_to(receiver, takes_faces) && (description_.may_record || !records);
    }
    // The last minute of it may be shown again: a camera of the room that may be recorded. Nobody
    // is shown as a person was: the person's pose is that of now.
    bool may_be_kept() const {
        return description_.may_record && description_.kind == wire::CameraKind::room &&
               !sees_person_;
    }
    StreamId stream(bool depth) const {
        return depth ? description_.depth_stream : description_.color_stream;
    }

    SettingTable& table(bool depth) { return depth ? depth_ : color_; }
    const SettingTable& table(bool depth) const { return depth ? depth_ : color_; }

    // The settings that were sent to a receiver last; {} before.
    struct Told {
        SettingId depth{}, color{};
        int highest_layer = 0;  // that it is sent
        SettingId of(bool is_depth) const { return is_depth ? depth : color; }
    };
    std::map<ParticipantId, Told> receivers;

    std::optional<wire::CameraState> state;  // the publisher's newest

    // As they were given, before they were told apart from others; empty: the host's.
    std::string publisher_name, given_name;
    int slot = 0;  // unique in the session; the position of a camera without a place

    // The active settings are others than at the last take_change().
    bool has_change() const {
        return known_depth_ != depth_.active() || known_color_ != color_.active();
    }
    // Settings that were active at the last call and are not any more; empty if the active settings
    // have not changed.
    std::optional<std::vector<SettingId>> take_change();

    // Encoding in this setting no longer keeps up, or does again. True if that is new.
    bool set_slow(bool depth, SettingId setting, bool is_slow);
    bool is_slow(bool depth, const std::string& codec) const;

    // A frame of this camera was encoded. Its layer for receivers, or none if its setting is not
    // active.
    std::optional<int> on_media(const wire::MediaHeader& header, TimePoint now);
    // The layer of a colour frame for a receiver that gets this depth setting: that of the depth
    // frame of the same number, so that the same moments are left out of both.
    int color_layer(FrameNumber frame, SettingId depth) const;
    // Estimated time from exposure to the encoded frame; 0 if nothing was encoded.
    Duration made_in(SettingId setting) const;

private:
    struct NewestDepth {
        FrameNumber frame = 0;
        int layer = 0;
    };
    const wire::CameraKind offered_as_;
    wire::Camera description_;
    Pose registered_;            // the room from the camera
    bool has_own_gain_ = false;  // in its calibration
    std::optional<Vec3> estimated_gain_;
    bool sees_person_ = false;  // of a recording
    CameraAdjustment adjustment_;
    SettingTable depth_, color_;
    std::function<bool(std::uint8_t)> refers_;              // as in CodecSteps
    std::vector<ActiveSetting> known_depth_, known_color_;  // at the last take_change()
    std::set<SettingId> slow_;
    std::map<SettingId, Duration> made_in_;
    std::map<SettingId, NewestDepth> newest_depth_;
};

}  // namespace theatron::session
