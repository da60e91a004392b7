// SPDX-License-Identifier: Apache-2.0
// All cameras of a session: their numbers, their places in the room, how they were adjusted, and
// their newest states. A pure state machine; it tells nobody of changes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/ids.h"
#include "session/camera_adjustment.h"
#include "session/camera_numbers.h"
#include "session/camera_streams.h"
#include "session/kept_adjustments.h"

namespace theatron::session {

// The publisher of the host's own cameras.
inline constexpr ParticipantId host_publisher{0};

class SessionCameras {
public:
    struct Config {
        CodecSteps codecs;
        CameraStreams::Usual usual;               // in canonical spelling; empty: none
        std::vector<KeptAdjustment> adjustments;  // of the previous run
    };
    // `numbers` must outlive the cameras.
    SessionCameras(Config config, SettingNumbers& numbers)
        : config_(std::move(config)), numbers_(numbers), adjustments_(config_.adjustments) {}

    // Distance along x between cameras without a known place in the room: so large that none is in
    // another's picture.
    static constexpr double unregistered_distance_m = 12;

    // Gives a camera its number and its streams. A camera without a place
    // in the room is put beside the others. One that was adjusted before is so again.
    // `publisher_name` and `given_name`: see CameraStreams. Needs has_numbers_for() it. The host's
    // own have their numbers already.
    CameraStreams& add(ParticipantId publisher, wire::Camera camera,
                       const std::string& publisher_name, const std::string& given_name);
    // The numbers below this one are those of the host's own cameras. Before the first is added.
    void keep_numbers(int below) { camera_numbers_.keep(below); }
    // An unknown camera is skipped.
    void remove(CameraId camera) {
        if (cameras_.erase(camera) > 0)
            camera_numbers_.give_back(camera);
    }
    // Numbers of cameras that left are used again after a while.
    void on_time(TimePoint now) { camera_numbers_.on_time(now); }

    // The number of the next camera, or of the one `further` behind it. Needs has_numbers_for()
    // them.
    CameraId next_id(std::size_t further) const { return camera_numbers_.next(further); }
    bool has_numbers_for(std::size_t cameras) const { return camera_numbers_.has(cameras); }
    // A camera has or had this number.
    bool was_given(CameraId camera) const { return camera_numbers_.was_given(camera); }
    std::size_t size() const { return cameras_.size(); }
    // The pictures of faces among the cameras.
    std::size_t faces() const;
    // Null if there is no such camera.
    const CameraStreams* find(CameraId camera) const;
    CameraStreams* find(CameraId camera);
    std::vector<CameraId> of(ParticipantId publisher) const;
    std::vector<wire::Camera> descriptions() const;
    // The cameras that a participant is told of: all but its own.
    std::vector<wire::Camera> seen_by(ParticipantId participant, bool takes_faces = false) const;
    std::vector<wire::CameraState> states_seen_by(ParticipantId participant,
                                                  bool takes_faces = false) const;
    double frames_per_second() const;  // of the fastest, at least 1

    // By number.
    auto begin() { return cameras_.begin(); }
    auto end() { return cameras_.end(); }
    auto begin() const { return cameras_.begin(); }
    auto end() const { return cameras_.end(); }

    // Cameras that move with a person cannot be adjusted, and only the host's own have a region.
    wire::ManageRefusal adjust(CameraId camera, const CameraAdjustment& adjustment);
    // A camera is registered anew, with the same lenses.
    void set_calibration(CameraStreams& camera, const Bytes& calibration);
    // Those of all cameras that are or were here.
    const std::vector<KeptAdjustment>& adjustments() const { return adjustments_.all(); }

private:
    int free_slot() const;

    const Config config_;
    SettingNumbers& numbers_;
    CameraNumbers camera_numbers_;
    std::map<CameraId, CameraStreams> cameras_;
    KeptAdjustments adjustments_;
};

}  // namespace theatron::session
