// SPDX-License-Identifier: Apache-2.0
#include "viewer/handling.h"

#include <utility>

#include "phrases/phrase.h"
#include "session/shared_screen.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

void Handling::on_input(window::WindowInput& input, bool part, std::optional<double> surface_m,
                        double aspect, const render::CameraView& view, Meeting& meeting,
                        client::Participant& participant, TimePoint now) {
    if (!hold_.holds())
        screen_.on_input(input, surface_m, aspect, view, meeting, participant, now);
    if (input.grabbed && input.grabbed_left)
        grab(*input.grabbed, part, surface_m, view, meeting, participant);
    const HoldRoom room = meeting.held_room();
    if (hold_.follow(room)) {
        if (session::is_shared_screen(room.objects.at(hold_.object())))
            change_width(input, room);
        input.grabbed.reset();
        pointer_.x += std::exchange(input.steering.turn.x, 0) / aspect;
        pointer_.y += std::exchange(input.steering.turn.y, 0);
        const double clicks = std::exchange(input.steering.approach, 0);
        hold_.grasp()->point({render::ray_through(view, pointer_)});
        if (input.steering.fast)
            hold_.grasp()->turn(clicks * Grasp::turn_per_click);
        else
            hold_.grasp()->approach(clicks);
        const HoldMove move = *hold_.move(room);
        (void)participant.move_object(move.object, move.room_from_object, move.scale);
    }
    for (const window::KeyPress& key : input.keys)
        on_key(key.action, view, meeting, participant);
    if (hold_.holds() && input.released)
        pass(hold_.let_go(room), participant);
}

// The keys that change the size of points change the width of the held screen.
void Handling::change_width(window::WindowInput& input, const HoldRoom& room) {
    std::erase_if(input.keys, [&](const window::KeyPress& key) {
        const bool larger = key.action == window::Action::larger_points;
        if (!larger && key.action != window::Action::smaller_points)
            return false;
        const double factor = larger ? screen_width_step : 1 / screen_width_step;
        (void)hold_.set_scale(room, session::clamped_screen_width(hold_.scale() * factor));
        return true;
    });
}

void Handling::grab(Vec2 pointer, bool part, std::optional<double> surface_m,
                    const render::CameraView& view, Meeting& meeting,
                    client::Participant& participant) {
    const render::PickRay ray = render::ray_through(view, pointer);
    const auto hit = meeting.pick(ray, view);
    if (!hit || is_hidden(hit->picked.place, surface_m, view))
        return;
    pass(hold_.take(meeting.held_room(), hit->object, part, Grip{ray}, hit->picked.place),
         participant);
    pointer_ = pointer;
    (void)meeting.take(participant);
}

void Handling::pass(const HoldStep& step, client::Participant& participant) {
    ask(step, participant);
    if (!step.note.empty())
        note_ = step.note;
}

void Handling::on_key(window::Action action, const render::CameraView& view, const Meeting& meeting,
                      client::Participant& participant) {
    if (action == window::Action::new_brick)
        make_brick(view, participant);
    else if (action != window::Action::remove && action != window::Action::give)
        return;
    else if (!hold_.holds())
        note_ = say(Phrase::hold_first);
    else if (action == window::Action::remove)
        pass(hold_.remove(meeting.held_room()), participant);
    else
        pass(hold_.give_to_nearest(meeting.held_room()), participant);
}

void Handling::make_brick(const render::CameraView& view, client::Participant& participant) {
    const Vec3 ahead = view.room_from_eye * Vec3{0, 0, new_brick_distance_m};
    participant.ask_room(session::request::Create{
        session::ObjectKind::brick, {{}, ahead}, 1, room::encode_brick({4, 2, next_color_++})});
}

std::string Handling::take_note() {
    return std::exchange(note_, "");
}

}  // namespace theatron::viewer
