// SPDX-License-Identifier: Apache-2.0
#include "session/announced_cameras.h"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/calibration.h"

namespace theatron::session {
namespace {

using wire::TextCode;

constexpr double max_frames_per_second = 1000;

// The problem of a camera by itself; none if it has no problem.
wire::Text problem_of(const wire::Camera& camera, const Result<Calibration>& calibration) {
    if (int(camera.id) > max_camera_number)
        return {TextCode::camera_number_too_high, {camera.name, std::to_string(int(camera.id))}};
    if (camera.depth_stream != depth_stream(camera.id) ||
        (camera.has_color && camera.color_stream != color_stream(camera.id)))
        return {TextCode::camera_foreign_streams, {camera.name}};
    if (!(camera.frames_per_second >= 0 && camera.frames_per_second <= max_frames_per_second))
        return {TextCode::camera_bad_rate, {camera.name}};
    if (!calibration)
        return {TextCode::camera_bad_calibration,
                {camera.name, std::string(to_text(calibration.error()))}};
    if (calibration->depth.size == Size{})
        return {TextCode::camera_without_depth, {camera.name}};
    return {};
}

// The pixels of all accepted cameras together.
class Room {
public:
    // False, and nothing changes, if the camera does not fit beside them.
    bool take(const Calibration& calibration) {
        const std::size_t depth = depth_ + calibration.depth.size.area(),
                          color = color_ + calibration.color.size.area();
        if (depth > max_total_depth_pixels || color > max_total_color_pixels)
            return false;
        depth_ = depth;
        color_ = color;
        return true;
    }

private:
    std::size_t depth_ = 0, color_ = 0;
};

}  // namespace

AnnouncedCameras judge_cameras(std::vector<wire::Camera> announced) {
    AnnouncedCameras result;
    std::set<CameraId> known;
    Room room;
    for (wire::Camera& camera : announced) {
        const auto calibration = decode_calibration(camera.calibration);
        wire::Text problem = problem_of(camera, calibration);
        if (problem.empty() && result.accepted.size() == wire::max_cameras)
            problem = {TextCode::one_camera_too_many, {camera.name}};
        if (problem.empty() && !known.insert(camera.id).second)
            problem = {TextCode::camera_number_taken, {camera.name}};
        if (problem.empty() && !room.take(*calibration))
            problem = {TextCode::camera_too_many_pixels, {camera.name}};
        if (problem.empty())
            result.accepted.push_back(std::move(camera));
        else
            result.left_out.push_back(std::move(problem));
    }
    return result;
}

}  // namespace theatron::session
