// SPDX-License-Identifier: Apache-2.0
// The tools and pointing of the person at the window.
#include <cmath>

#include "viewer/viewer.h"

namespace theatron::viewer {
namespace {

// A hand at `place` that points along `direction`: y up, -z forward.
Pose look_along(Vec3 place, Vec3 direction) {
    const Vec3 up = std::abs(direction.y) > 0.999 ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
    return look_at(place, place + direction, up) * Pose{Quat{0, 1, 0, 0}, {}};
}

}  // namespace

void Viewer::use_tool(window::WindowInput& input, Size picture, TimePoint now) {
    // With a headset the hands have the tool.
    if (!tools_.any() || !eye_.is_placed() || headset_)
        return;
    const render::CameraView view = eye_.view(picture);
    const std::vector<CloudCamera> cloud = scene_.cloud();
    const ToolScene scene{scene_.meeting(), view, cloud, participant_, now};
    if (input.grabbed && input.grabbed_left &&
        tools_.on_pointer({render::ray_through(view, *input.grabbed), true, false}, scene))
        input.grabbed.reset();
    Pointer pointer{std::nullopt, false, input.released};
    if (input.pointer)
        pointer.ray = render::ray_through(view, *input.pointer);
    if (tools_.on_pointer(pointer, scene)) {
        input.steering.turn = {};
        scene_changed_ = true;
    }
}

// The ray begins below the eye, so that its owner sees it from the side.
void Viewer::point(const window::WindowInput& input, Size picture) {
    constexpr Vec3 hand_from_eye{0.15, 0.25, 0.2};
    const bool pointed = pointer_.has_value();
    pointer_.reset();
    if (input.points && input.pointer && eye_.is_placed()) {
        const render::CameraView view = eye_.view(picture);
        const render::PickRay ray = render::ray_through(view, *input.pointer);
        const auto at = surface_at(ray, view, scene_.meeting(), scene_.cloud());
        const Vec3 to =
            at ? at->place : ray.from + normalized(ray.direction) * room::Pointers::free_reach_m;
        const Vec3 from = view.room_from_eye * hand_from_eye;
        if (length(to - from) > 0.01)
            pointer_ = room::Pointer{scene_.meeting().room().self, "", from, normalized(to - from),
                                     std::nullopt};
    }
    if (pointed || pointer_) {
        scene_.set_own_pointers(pointer_ ? std::vector{*pointer_} : std::vector<room::Pointer>{});
        scene_changed_ = true;
    }
}

void Viewer::add_pointing(wire::PersonPose& pose) {
    sent_pointing_ = pointer_.has_value();
    if (!pointer_)
        return;
    pose.right_hand = part_of(look_along(pointer_->from, pointer_->direction));
    pose.points = true;
}

}  // namespace theatron::viewer
