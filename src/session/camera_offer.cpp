// SPDX-License-Identifier: Apache-2.0
#include "session/camera_offer.h"

#include <algorithm>
#include <utility>

#include "session/announced_cameras.h"
#include "session/face_limits.h"

namespace theatron::session {
namespace {

using wire::TextCode;

// The same for the faces among them, `new_faces` of them.
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
    const std::vector<CameraId> own = present.of(id);
    const bool has_one = std::any_of(
        own.begin(), own.end(), [&](CameraId camera) { return present.find(camera)->is_face(); });
    if (new_faces > 1 || has_one)
        return {TextCode::one_face};
    if (present.faces() >= max_faces)
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
    const auto new_faces =
        std::size_t(std::count_if(cameras.begin(), cameras.end(), [](const wire::Camera& camera) {
            return camera.kind == wire::CameraKind::face;
        }));
    if (new_faces < cameras.size() && !publisher.has(wire::Feature::publish))
        return {TextCode::link_without_cameras};
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
