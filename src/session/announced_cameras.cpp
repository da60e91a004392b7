// SPDX-License-Identifier: Apache-2.0
#include "session/announced_cameras.h"

#include <algorithm>
#include <set>

#include "geometry/calibration.h"

namespace theatron::session {
namespace {

constexpr double max_frames_per_second = 1000;

// The problem of a camera by itself, as the end of a sentence for the user; empty if none.
std::string problem_of(const wire::Camera& camera, const Result<Calibration>& calibration) {
    if (int(camera.id) > max_camera_number)
        return "has the number " + std::to_string(int(camera.id)) + ", beyond all that there are";
    if (camera.depth_stream != depth_stream(camera.id) ||
        (camera.has_color && camera.color_stream != color_stream(camera.id)))
        return "names streams that are not its own";
    if (!(camera.frames_per_second >= 0 && camera.frames_per_second <= max_frames_per_second))
        return "has a frame rate that is none";
    if (!calibration)
        return "has a calibration that is " + std::string(to_text(calibration.error()));
    return "";
}

// The pictures of all accepted cameras together.
class Room {
public:
    // False, and nothing changes, if the camera does not fit beside them.
    bool take(const Calibration& calibration) {
        Room with = *this;
        with.depth_.add(calibration.depth.size);
        with.color_.add(calibration.color.size);
        if (!with.depth_.fits(max_total_depth_pixels, max_array_factor * max_depth_pixels) ||
            !with.color_.fits(max_total_color_pixels, max_array_factor * max_color_pixels))
            return false;
        *this = with;
        return true;
    }

private:
    struct Pictures {
        std::size_t pixels = 0;
        Size largest;  // the widest and the highest
        void add(Size size) {
            pixels += size.area();
            largest = {std::max(largest.width, size.width), std::max(largest.height, size.height)};
        }
        bool fits(std::size_t max_pixels, std::size_t max_layer) const {
            return pixels <= max_pixels && largest.area() <= max_layer;
        }
    };
    Pictures depth_, color_;
};

}  // namespace

AnnouncedCameras judge_cameras(std::vector<wire::Camera> announced) {
    AnnouncedCameras result;
    std::set<CameraId> known;
    Room room;
    for (wire::Camera& camera : announced) {
        const auto calibration = decode_calibration(camera.calibration);
        std::string problem = problem_of(camera, calibration);
        if (problem.empty() && result.accepted.size() == wire::max_cameras)
            problem = "is one more than there can be";
        if (problem.empty() && !known.insert(camera.id).second)
            problem = "has a number that another one has";
        if (problem.empty() && !room.take(*calibration))
            problem = "has more pixels than there is room for beside the others";
        if (problem.empty())
            result.accepted.push_back(std::move(camera));
        else
            result.left_out.push_back("The camera " + camera.name + " " + problem +
                                      "; it is left out.");
    }
    return result;
}

}  // namespace theatron::session
