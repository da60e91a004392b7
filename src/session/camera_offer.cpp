// SPDX-License-Identifier: Apache-2.0
#include "session/camera_offer.h"

#include <algorithm>
#include <utility>

#include "session/announced_cameras.h"
#include "session/face_limits.h"
#include "session/screen_limits.h"

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

// As problem_of_offer(), for the faces among them, `new_faces` of them.
wire::Text problem_of_faces(ParticipantId id, const Admission::Participant& publisher,
                            const SessionCameras& present, const std::vector<wire::Camera>& cameras,
                            std::size_t new_faces) {
    if (!publisher.has(wire::Feature::webcam))
        return {TextCode::face_forbidden};
    for (const wire::Camera& camera : cameras) {
        if (camera.kind != wire::CameraKind::face)
            continue;
        const auto calibration = decode_calibration(camera.calibration);
        if (!camera.has_color || !calibration || !is_face(*calibration, camera.frames_per_second))
            return {TextCode::face_beyond_limits,
                    {std::to_string(max_face_pixels), std::to_string(int(max_face_fps))}};
    }
    if (new_faces > 1 || has_one(id, present, wire::CameraKind::face))
        return {TextCode::one_face};
    if (present.faces() >= max_faces)
        return {TextCode::too_many_faces, {std::to_string(max_faces)}};
    return {};
}

// The same for the screens among them that a browser shows, `new_screens` of them.
wire::Text problem_of_screens(ParticipantId id, const Admission::Participant& publisher,
                              const SessionCameras& present,
                              const std::vector<wire::Camera>& cameras, std::size_t new_screens) {
    if (!publisher.has(wire::Feature::shows_screen))
        return {TextCode::screen_forbidden};
    for (const wire::Camera& camera : cameras) {
        if (camera.kind != wire::CameraKind::screen)
            continue;
        const auto calibration = decode_calibration(camera.calibration);
        if (!camera.has_color || !calibration ||
            !is_shown_screen(*calibration, camera.frames_per_second))
            return {TextCode::screen_beyond_limits,
                    {std::to_string(max_screen_pixels), std::to_string(int(max_screen_fps))}};
    }
    if (new_screens > 1 || has_one(id, present, wire::CameraKind::screen))
        return {TextCode::one_screen};
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
    const std::size_t new_faces = count_of(cameras, wire::CameraKind::face);
    const std::size_t new_screens = count_of(cameras, wire::CameraKind::screen);
    if (new_faces + new_screens < cameras.size() && !publisher.has(wire::Feature::publish))
        return {TextCode::link_without_cameras};
    if (new_screens > 0)
        if (wire::Text problem = problem_of_screens(id, publisher, present, cameras, new_screens);
            !problem.empty())
            return problem;
    if (new_faces > 0)
        if (wire::Text problem = problem_of_faces(id, publisher, present, cameras, new_faces);
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
