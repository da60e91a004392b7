// SPDX-License-Identifier: Apache-2.0
#include "viewer/handling.h"

#include <utility>

#include "phrases/phrase.h"
#include "session/shared_screen.h"
#include "viewer/case_actions.h"
#include "viewer/refusal_text.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {
namespace {

namespace request = session::request;

}  // namespace

void Handling::on_input(xr::WindowInput& input, std::optional<double> surface_m, double aspect,
                        const render::CameraView& view, Meeting& meeting,
                        client::Participant& participant, TimePoint now) {
    while (const auto refusal = participant.take_room_refusal())
        if (const std::string text = text_of(refusal->second); !text.empty())
            note_ = text;
    if (!held_)
        screen_.on_input(input, surface_m, aspect, view, meeting, participant, now);
    if (input.grabbed && input.grabbed_left)
        grab(*input.grabbed, input.steering.fast, surface_m, view, meeting, participant);
    // The object was removed or given away, or the host refused the grip.
    if (held_) {
        const session::RoomObject* object = meeting.find(held_->object);
        if (!object || object->grip.holder != participant.room_self())
            held_.reset();
        else if (session::is_shared_screen(*object))
            change_width(input);
    }
    if (held_) {
        input.grabbed.reset();
        held_->pointer.x += std::exchange(input.steering.turn.x, 0) / aspect;
        held_->pointer.y += std::exchange(input.steering.turn.y, 0);
        const double clicks = std::exchange(input.steering.approach, 0);
        held_->grasp.point(render::ray_through(view, held_->pointer));
        if (input.steering.fast)
            held_->grasp.turn(clicks);
        else
            held_->grasp.approach(clicks);
        (void)participant.move_object(
            held_->object, meeting.stored_pose(held_->object, held_->grasp.room_from_object()),
            held_->scale);
    }
    for (const xr::KeyPress& key : input.keys)
        on_key(key.action, view, meeting, participant);
    if (held_ && input.released)
        release(meeting, participant);
}

// The keys that change the size of points change the width of the held screen.
void Handling::change_width(xr::WindowInput& input) {
    std::erase_if(input.keys, [&](const xr::KeyPress& key) {
        const bool larger = key.action == xr::Action::larger_points;
        if (!larger && key.action != xr::Action::smaller_points)
            return false;
        held_->scale = session::clamped_screen_width(
            held_->scale * (larger ? screen_width_step : 1 / screen_width_step));
        return true;
    });
}

void Handling::grab(Vec2 pointer, bool part, std::optional<double> surface_m,
                    const render::CameraView& view, Meeting& meeting,
                    client::Participant& participant) {
    const render::PickRay ray = render::ray_through(view, pointer);
    auto hit = meeting.pick(ray, view);
    if (!hit || is_hidden(hit->picked.place, surface_m, view))
        return;
    if (const auto& open = meeting.case_scene().in_room(); open && !part && open->find(hit->object))
        hit->object = open->organ_id;
    const session::RoomObject* object = meeting.find(hit->object);
    if (!object)
        return;
    // A pinned screen is part of the room, around which one turns.
    if (session::is_pinned(*object))
        return;
    if (object->grip.holder != ParticipantId{} && object->grip.holder != participant.room_self()) {
        note_ = say(Phrase::holds_this, meeting.name_of(object->grip.holder));
        return;
    }
    const std::uint32_t grip = participant.ask_room(request::Grab{hit->object});
    if (grip == 0)
        return;
    held_ = Held{hit->object, grip, Grasp(meeting.shown_pose(hit->object), ray, hit->picked.place),
                 pointer, object->scale};
    (void)meeting.take(participant);
}

void Handling::release(const Meeting& meeting, client::Participant& participant) {
    const Pose pose = meeting.stored_pose(
        held_->object, meeting.resting(held_->object, held_->grasp.room_from_object()));
    participant.ask_room(request::Release{held_->object, held_->grip, pose, held_->scale});
    held_.reset();
}

void Handling::on_key(xr::Action action, const render::CameraView& view, const Meeting& meeting,
                      client::Participant& participant) {
    if (action == xr::Action::new_brick) {
        make_brick(view, participant);
    } else if (action == xr::Action::remove && held_) {
        const auto& open = meeting.case_scene().in_room();
        if (const auto* part = open ? open->find(held_->object) : nullptr) {
            const std::size_t number = part->facts.part;
            release(meeting, participant);
            show_part(participant, number, false);
            return;
        }
        if (const auto* object = meeting.find(held_->object);
            object && session::is_shared_screen(*object)) {
            note_ = say(Phrase::use_screens_panel);
            return;
        }
        if (open && (held_->object == open->organ_id ||
                     (open->screen && held_->object == open->screen->id))) {
            note_ = say(Phrase::use_case_panel);
            return;
        }
        participant.ask_room(request::Remove{held_->object});
        held_.reset();
    } else if (action == xr::Action::give && held_) {
        const auto to = meeting.nearest_person(held_->grasp.room_from_object().translation);
        if (!to) {
            note_ = say(Phrase::nobody_near);
            return;
        }
        participant.ask_room(request::HandOver{held_->object, held_->grip, *to});
        note_ = say(Phrase::given_to, meeting.name_of(*to));
        held_.reset();
    } else if ((action == xr::Action::give || action == xr::Action::remove) && !held_) {
        note_ = say(Phrase::hold_first);
    }
}

void Handling::make_brick(const render::CameraView& view, client::Participant& participant) {
    const Vec3 ahead = view.room_from_eye * Vec3{0, 0, new_brick_distance_m};
    participant.ask_room(request::Create{
        session::ObjectKind::brick, {{}, ahead}, 1, room::encode_brick({4, 2, next_color_++})});
}

std::string Handling::take_note() {
    return std::exchange(note_, "");
}

}  // namespace theatron::viewer
