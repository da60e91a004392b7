// SPDX-License-Identifier: Apache-2.0
#include "session/camera_offer.h"

#include <algorithm>
#include <utility>

#include "session/announced_cameras.h"
#include "session/own_pictures.h"

namespace theatron::session {
namespace {

using wire::TextCode;

std::size_t count_of(const std::vector<wire::Camera>& cameras, wire::CameraKind kind) {
    return std::size_t(
        std::count_if(cameras.begin(), cameras.end(),
                      [&](const wire::Camera& camera) { return camera.kind == kind; }));
}

// True if the participant sends one of this kind already.
bool has_one(ParticipantId id, const SessionCameras& present, wire::CameraKind kind) {
    const std::vector<CameraId> own = present.of(id);
    return std::any_of(own.begin(), own.end(),
                       [&](CameraId camera) { return present.find(camera)->offered_as() == kind; });
}

// As problem_of_offer(), for the faces or shown screens among them, which are of this kind.
wire::Text problem_of_own_pictures(ParticipantId id, const Admission::Participant& publisher,
                                   const SessionCameras& present,
                                   const std::vector<wire::Camera>& cameras,
                                   wire::CameraKind kind) {
    const std::size_t count = count_of(cameras, kind);
    if (count == 0)
        return {};
    const OwnPictureLimits& limits = *own_picture_limits(kind);
    if (!publisher.has(limits.feature))
        return {limits.forbidden};
    for (const wire::Camera& camera : cameras) {
        if (camera.kind != kind)
            continue;
        const auto calibration = decode_calibration(camera.calibration);
        if (!camera.has_color || !calibration ||
            !is_within(limits, *calibration, camera.frames_per_second))
            return {limits.beyond_limits,
                    {std::to_string(limits.max_pixels), std::to_string(int(limits.max_fps))}};
    }
    if (count > 1 || has_one(id, present, kind))
        return {limits.one_each};
    if (kind == wire::CameraKind::face && present.faces() >= max_faces)
        return {TextCode::too_many_faces, {std::to_string(max_faces)}};
    return {};
}

}  // namespace

std::vector<wire::Camera> cameras_of(const wire::Publish& offer, wire::SessionId session) {
    std::vector<wire::Camera> cameras;
    for (const wire::OfferedCamera& offered : offer.cameras) {
        wire::Camera camera;
        camera.name = offered.name;
        camera.has_color = offered.has_color;
        camera.frames_per_second = offered.frames_per_second;
        camera.calibration = offered.calibration;
        camera.may_record = offered.may_record;
        camera.session = session;
        camera.kind = offered.kind;
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

wire::Text problem_of_offer(ParticipantId id, const Admission::Participant& publisher,
                            const SessionCameras& present,
                            const std::vector<wire::Camera>& cameras) {
    if (cameras.empty())
        return {TextCode::no_camera_offered};
    const bool is_own = std::all_of(cameras.begin(), cameras.end(), [](const wire::Camera& camera) {
        return own_picture_limits(camera.kind) != nullptr;
    });
    if (!is_own && !publisher.has(wire::Feature::publish))
        return {TextCode::link_without_cameras};
    for (const wire::CameraKind kind : {wire::CameraKind::screen, wire::CameraKind::face})
        if (wire::Text problem = problem_of_own_pictures(id, publisher, present, cameras, kind);
            !problem.empty())
            return problem;
    if (present.of(id).size() + cameras.size() > max_published)
        return {TextCode::too_many_own_cameras, {std::to_string(max_published)}};
    if (present.size() + cameras.size() > wire::max_cameras)
        return {TextCode::session_full, {std::to_string(wire::max_cameras)}};
    if (!present.has_numbers_for(cameras.size()))
        return {TextCode::no_camera_numbers};
    // The same check as in every participant.
    std::vector<wire::Camera> all = present.descriptions();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        all.push_back(cameras[i]);
        all.back().id = present.next_id(i);
        all.back().depth_stream = depth_stream(all.back().id);
        all.back().color_stream = color_stream(all.back().id);
    }
    const AnnouncedCameras judged = judge_cameras(std::move(all));
    return judged.left_out.empty() ? wire::Text() : judged.left_out.back();
}

// No codec makes a picture much larger than its pixels (receive::max_media_size).
std::size_t max_media_size(const Calibration& calibration) {
    constexpr std::size_t overhead = 64 * 1024, bytes_per_pixel = 4;
    return wire::media_header_size + overhead +
           bytes_per_pixel * std::max(calibration.depth.size.area(), calibration.color.size.area());
}

}  // namespace theatron::session
