// SPDX-License-Identifier: Apache-2.0
// The viewpoint of a person with mouse and keyboard. It starts at a camera's own view and moves
// with the input.
#pragma once

#include <map>
#include <optional>

#include "room/moving.h"
#include "viewer/view_choice.h"
#include "window/navigation.h"

namespace theatron::viewer {

// The cameras whose view the eye can take. Both maps must outlive the call that takes them.
struct ViewableCameras {
    const std::map<CameraId, Calibration>& calibrations;
    const std::map<CameraId, receive::CameraFramePtr>& newest;  // of cameras that sent a picture
};

// For an eye that did not start from a camera.
CameraModel usual_lens();

// Reads no clock; from one thread. `picture` is the size of the picture in pixels.
class Eye {
public:
    // Time for which the eye waits for the first picture of the chosen camera. Then it starts at
    // another one.
    static constexpr Duration camera_patience = std::chrono::seconds(2);

    explicit Eye(const ViewChoice& home) : home_(home) {}

    // False until some camera has sent a picture.
    bool is_placed() const { return viewpoint_.has_value(); }
    const ViewChoice& home() const { return home_; }
    // Needs is_placed(). The eye has the lens of the camera whose view it started from, else
    // usual_lens().
    render::CameraView view(Size picture) const;

    // Moves to this camera's view, which becomes the home view. Throws Error if the camera does not
    // exist or has sent nothing.
    void go_home(const ViewChoice& choice, const ViewableCameras& cameras, Size picture);

    // To be called with every new picture. Places the eye as soon as its camera has sent one, and
    // follows that camera if it is moved, until the person has gone elsewhere. True if the view
    // changed. With `must_exist`, throws Error if there is no camera of the chosen number.
    bool follow(const ViewableCameras& cameras, bool must_exist, Size picture, TimePoint now);

    // Needs !is_placed(): places the eye without a camera. It takes a camera's view as soon as the
    // camera has sent a picture, unless the person has moved.
    void stand(const Pose& room_from_eye);

    // The eye stays in this space when it flies or slides, unless an orbit took it out.
    void set_space(const std::optional<room::FreeSpace>& space) { space_ = space; }

    // Needs is_placed(). Moves the eye to this pose (z forward, y down), whose pivot is ahead of it
    // at the distance of the present one. Until the person moves, nothing is seen that is nearer
    // than `nearest_m` along the axis.
    void go_to(const Pose& room_from_eye, std::optional<double> nearest_m = std::nullopt);

    // Begins a turn or a slide. `place` is in shares of the picture's width and height; the surface
    // there, at `distance_m` along the view's axis, stays under the mouse.
    void grab(Vec2 place, double distance_m, Size picture);

    // Moves as in xr/navigation.h; keys count from the last call. True if the view changed.
    bool steer(const window::Steering& steering, Size picture, TimePoint now);

private:
    ViewChoice home_;
    std::optional<window::Viewpoint> viewpoint_;
    CameraModel lens_;
    Pose home_pose_;  // of the camera when the view started from it
    std::optional<room::FreeSpace> space_;
    bool moved_ = false;  // away from the home view
    bool flying_ = false;
    std::optional<double> nearest_m_;
    TimePoint steered_at_, first_picture_at_;
};

}  // namespace theatron::viewer
