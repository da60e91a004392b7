// SPDX-License-Identifier: Apache-2.0
// The tools and pointing of the person at the window.
#include "viewer/first_met.h"
#include "viewer/pointing_hand.h"
#include "viewer/viewer.h"

namespace theatron::viewer {

void Viewer::use_tool(window::WindowInput& input, Size picture, TimePoint now) {
    // With a headset the hands have the tool.
    if (!tools_.any() || !eye_.is_placed() || headset_) {
        missed_with_tool_ = false;
        return;
    }
    const render::CameraView view = eye_.view(picture);
    const std::vector<CloudCamera> cloud = scene_.cloud();
    const ToolScene scene{scene_.meeting(), view, cloud, participant_, now};
    if (input.grabbed && input.grabbed_left)
        press_with_tool(input, scene);
    Pointer pointer{std::nullopt, false, input.released};
    if (input.pointer)
        pointer.ray = render::ray_through(view, *input.pointer);
    const bool uses = tools_.on_pointer(pointer, scene);
    if (uses || missed_with_tool_)
        input.steering.turn = {};
    scene_changed_ = scene_changed_ || uses || tools_.follows_pointer();
    missed_with_tool_ = missed_with_tool_ && !input.released;
    if (const auto advice = tools_.take_advice())
        note(say(*advice), now);
    if (!tools_.follows_pointer())
        notice_.take_back(say(Phrase::press_at_other_end));
}

bool Viewer::give_up_mark() {
    if (!tools_.give_up(scene_.meeting()))
        return false;
    notice_.take_back(say(Phrase::press_at_other_end));
    scene_changed_ = true;
    return true;
}

// A press on nothing does not turn the view while one draws: the drawing would go elsewhere.
void Viewer::press_with_tool(window::WindowInput& input, const ToolScene& scene) {
    const render::PickRay ray = render::ray_through(scene.view, *input.grabbed);
    const bool uses = tools_.on_pointer({ray, true, false}, scene);
    missed_with_tool_ = !uses && marks_of(tools_.chosen()) && !scene.meeting.pick(ray, scene.view);
    if (missed_with_tool_)
        note(say(Phrase::begin_on_surface), scene.now);
    if (uses || missed_with_tool_)
        input.grabbed.reset();
    scene_changed_ = true;
}

void Viewer::point(const window::WindowInput& input, Size picture) {
    const bool pointed = pointer_.has_value();
    pointer_.reset();
    if (input.points && input.pointer && eye_.is_placed()) {
        const std::vector<CloudCamera> cloud = scene_.cloud();
        const render::CameraView view = eye_.view(picture);
        render::SceneFrame objects;
        scene_.meeting().add_to(objects, view);
        const render::PickRay ray =
            pointing_ray(view, *input.pointer, [&](const render::PickRay& tried) {
                const auto met = first_met(objects, cloud, tried);
                return met ? std::optional(met->place) : std::nullopt;
            });
        pointer_ =
            room::Pointer{scene_.meeting().room().self, "", ray.from, ray.direction, std::nullopt};
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
    pose.right_hand = part_of(hand_on({pointer_->from, pointer_->direction}));
    pose.points = true;
}

}  // namespace theatron::viewer
