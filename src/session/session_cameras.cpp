// SPDX-License-Identifier: Apache-2.0
#include "session/session_cameras.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "geometry/calibration.h"
#include "session/announced_cameras.h"

namespace theatron::session {
namespace {

// Moves a camera whose place in the room is not known.
Bytes stand_apart(const Bytes& encoded, double distance_m) {
    auto calibration = decode_calibration(encoded);
    if (!calibration || calibration->registered || distance_m == 0)
        return encoded;
    calibration->room_from_camera.translation.x += distance_m;
    return encode_calibration(*calibration);
}

bool can_be_adjusted(const CameraStreams& camera, const CameraAdjustment& adjustment) {
    const auto calibration = decode_calibration(camera.description().calibration);
    return calibration && calibration->person == 0 &&
           camera.description().kind == wire::CameraKind::room &&
           (!adjustment.region || camera.publisher() == host_publisher) &&
           is_within_limits(adjustment, calibration->depth.size);
}

}  // namespace

int SessionCameras::free_slot() const {
    std::set<int> taken;
    for (const auto& [id, camera] : cameras_)
        if (!camera.is_face())
            taken.insert(camera.slot);
    int slot = 0;
    while (taken.contains(slot))
        ++slot;
    return slot;
}

CameraStreams& SessionCameras::add(ParticipantId publisher, wire::Camera camera,
                                   const std::string& publisher_name,
                                   const std::string& given_name) {
    if (publisher == host_publisher) {
        camera_numbers_.keep(int(camera.id) + 1);
    } else {
        assert(has_numbers_for(1));
        camera.id = camera_numbers_.take();
    }
    camera.depth_stream = depth_stream(camera.id);
    camera.color_stream = color_stream(camera.id);
    camera.publisher = publisher;
    camera.may_record = camera.may_record || publisher == host_publisher;
    const int slot = free_slot();
    camera.calibration = stand_apart(camera.calibration, slot * unregistered_distance_m);
    CameraStreams& added =
        cameras_.try_emplace(camera.id, camera, numbers_, config_.usual, config_.codecs)
            .first->second;
    added.slot = slot;
    added.publisher_name = publisher_name;
    added.given_name = given_name;
    const CameraAdjustment* kept =
        adjustments_.find(publisher_name, given_name, added.registered());
    if (kept && can_be_adjusted(added, *kept))
        added.adjust(*kept);
    return added;
}

std::size_t SessionCameras::faces() const {
    return std::size_t(std::count_if(cameras_.begin(), cameras_.end(),
                                     [](const auto& entry) { return entry.second.is_face(); }));
}

const CameraStreams* SessionCameras::find(CameraId camera) const {
    const auto found = cameras_.find(camera);
    return found == cameras_.end() ? nullptr : &found->second;
}

CameraStreams* SessionCameras::find(CameraId camera) {
    const auto found = cameras_.find(camera);
    return found == cameras_.end() ? nullptr : &found->second;
}

std::vector<CameraId> SessionCameras::of(ParticipantId publisher) const {
    std::vector<CameraId> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.publisher() == publisher)
            result.push_back(id);
    return result;
}

std::vector<wire::Camera> SessionCameras::descriptions() const {
    std::vector<wire::Camera> result;
    for (const auto& [id, camera] : cameras_)
        result.push_back(camera.description());
    return result;
}

std::vector<wire::Camera> SessionCameras::seen_by(ParticipantId participant,
                                                  bool takes_faces) const {
    std::vector<wire::Camera> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.is_told_to(participant, takes_faces))
            result.push_back(camera.description());
    return result;
}

std::vector<wire::CameraState> SessionCameras::states_seen_by(ParticipantId participant,
                                                              bool takes_faces) const {
    std::vector<wire::CameraState> result;
    for (const auto& [id, camera] : cameras_)
        if (camera.is_told_to(participant, takes_faces) && camera.state)
            result.push_back(*camera.state);
    return result;
}

double SessionCameras::frames_per_second() const {
    double fastest = 1;
    for (const auto& [id, camera] : cameras_)
        fastest = std::max(fastest, camera.description().frames_per_second);
    return fastest;
}

wire::ManageRefusal SessionCameras::adjust(CameraId id, const CameraAdjustment& adjustment) {
    CameraStreams* const camera = find(id);
    if (!camera || !can_be_adjusted(*camera, {}))
        return wire::ManageRefusal::no_such_camera;
    if (!can_be_adjusted(*camera, adjustment))
        return wire::ManageRefusal::beyond_limits;
    camera->adjust(adjustment);
    adjustments_.keep(
        {camera->publisher_name, camera->given_name, camera->registered(), camera->adjustment()});
    return wire::ManageRefusal::none;
}

void SessionCameras::set_calibration(CameraStreams& camera, const Bytes& calibration) {
    camera.set_calibration(stand_apart(calibration, camera.slot * unregistered_distance_m));
}

}  // namespace theatron::session
