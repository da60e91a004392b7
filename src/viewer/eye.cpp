// SPDX-License-Identifier: Apache-2.0
#include "viewer/eye.h"

#include <utility>

#include "room/moving.h"

namespace theatron::viewer {

CameraModel usual_lens() {
    return pinhole({1280, 720}, 80);
}

render::CameraView Eye::view(Size picture) const {
    render::CameraView view = render::view_of_camera(lens_, viewpoint_->room_from_eye, picture);
    if (nearest_m_)
        view.near_m = *nearest_m_;
    return view;
}

void Eye::go_home(const ViewChoice& choice, const ViewableCameras& cameras, Size picture) {
    const auto own = choice.resolve(cameras.calibrations, cameras.newest, picture);
    const Calibration& calibration = cameras.calibrations.at(choice.camera);
    const DepthView depth = cameras.newest.at(choice.camera)->depth.view();
    viewpoint_ = {own.room_from_eye, render::point_of_interest(calibration, depth)};
    lens_ = calibration.depth;
    home_ = choice;
    moved_ = false;
    nearest_m_.reset();
}

bool Eye::follow(const ViewableCameras& cameras, bool must_exist, Size picture, TimePoint now) {
    if (cameras.newest.empty())
        return false;
    if (first_picture_at_ == TimePoint{})
        first_picture_at_ = now;
    if (viewpoint_ && moved_)
        return false;
    const CameraId wanted = home_.camera;
    if (!viewpoint_ && must_exist && cameras.calibrations.count(wanted) == 0)
        (void)home_.resolve(cameras.calibrations, cameras.newest, picture);  // throws the reason
    if (cameras.newest.count(wanted) == 0) {
        if (viewpoint_ || now - first_picture_at_ < camera_patience)
            return false;
        go_home({cameras.newest.begin()->first, 0, 0}, cameras, picture);
        return true;
    }
    // The point of interest is found once; only a camera that was moved is followed.
    const Pose& own = cameras.calibrations.at(wanted).room_from_camera;
    if (viewpoint_ && home_pose_ == own)
        return false;
    go_home(home_, cameras, picture);
    home_pose_ = own;
    return true;
}

void Eye::stand(const Pose& room_from_eye) {
    constexpr double pivot_m = 1.5;
    viewpoint_ = {room_from_eye, room_from_eye * Vec3{0, 0, pivot_m}};
    lens_ = usual_lens();
}

void Eye::go_to(const Pose& room_from_eye, std::optional<double> nearest_m) {
    const double distance = length(viewpoint_->pivot - viewpoint_->room_from_eye.translation);
    viewpoint_ = {room_from_eye, room_from_eye * Vec3{0, 0, distance}};
    moved_ = true;
    nearest_m_ = nearest_m;
}

void Eye::grab(Vec2 place, double distance_m, Size picture) {
    if (!viewpoint_)
        return;
    const render::CameraView v = view(picture);
    const Vec2 on_picture{v.left + place.x * (v.right - v.left),
                          v.top + place.y * (v.bottom - v.top)};
    viewpoint_ = window::around(*viewpoint_, on_picture, distance_m);
}

bool Eye::steer(const window::Steering& steering, Size picture, TimePoint now) {
    const bool flew = std::exchange(flying_, viewpoint_ && steering.fly != Vec3{});
    const Duration elapsed = flew ? now - steered_at_ : Duration{};
    steered_at_ = now;
    if (!viewpoint_ || !steering.moves())
        return false;
    const render::CameraView before = view(picture);
    viewpoint_ = window::steered(*viewpoint_, steering, before.bottom - before.top, elapsed);
    const bool travels = steering.fly != Vec3{} || steering.slide != Vec2{};
    if (space_ && travels) {
        Vec3& eye = viewpoint_->room_from_eye.translation;
        const Vec3 pushed = room::kept_inside(*space_, eye) - eye;
        eye = eye + pushed;
        viewpoint_->pivot = viewpoint_->pivot + pushed;
    }
    moved_ = true;
    nearest_m_.reset();
    return true;
}

}  // namespace theatron::viewer
