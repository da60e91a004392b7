// SPDX-License-Identifier: Apache-2.0
// The view of a person with a headset.
#include <utility>

#include "phrases/phrase.h"
#include "viewer/viewer.h"

namespace theatron::viewer {

void Viewer::enter_headset(bool real_room, double pictures_per_s, TimePoint now) {
    constexpr Size any{16, 9};
    stop_following();
    scene_.set_real_room(real_room);
    scene_.set_cover_shown(true);
    headset_.emplace(eye_.view(any).room_from_eye, real_room);
    headset_wish_.reset();
    open_plate(study_.is_on() && !study_.is_aside() ? Sheet::study : Sheet::none);
    tools_.choose(ToolKind::none, scene_.meeting());
    pace_limits_ = pace::limits_of_display(pictures_per_s);
    window_pace_ = pace_;
    begin_pace(pace_.ways());
    if (!real_room)
        note(say(Phrase::how_to_menu), now);
}

void Viewer::leave_headset() {
    if (!headset_)
        return;
    open_plate(Sheet::none);
    tools_.choose(ToolKind::none, scene_.meeting());
    headset_->leave(scene_, participant_);
    // Heads are tilted; the eye of a window stays upright.
    const Pose head = headset_->head().room_from_eye;
    eye_.go_to(room::standing_at({head.translation.x, 0, head.translation.z}, head,
                                 sits_ ? room::sitting_eyes_m : room::standing_eyes_m));
    headset_.reset();
    scene_.set_headset_text("");
    scene_.set_cover_shown(false);
    scene_.set_real_room(false);
    pace_limits_ = {};
    // The window goes on as it was measured to carry.
    if (window_pace_ && window_pace_->ways() == pace_.ways())
        pace_ = *window_pace_;
    else
        begin_pace(pace_.ways());
    window_pace_.reset();
    scene_changed_ = true;
}

void Viewer::on_headset(const xr::HeadsetFrame& frame, TimePoint now) {
    if (!headset_)
        return;
    tell_refusals(now);
    MenuFacts facts;
    facts.microphone_open = microphone_open_;
    facts.muted = participant_.status().standing.muted;
    facts.seated = headset_->is_seated();
    facts.real_room = scene_.has_real_room();
    facts.drawing = choice_.renderer() == automatic
                        ? say(Phrase::drawn_automatically, way().renderer)
                        : way().renderer;
    facts.people = scene_.meeting().people();
    facts.past = past(now);
    facts.studies = study_.is_on();
    if (scene_.past_moment() && tools_.any())
        tools_.choose(ToolKind::none, scene_.meeting());
    show_plate(now);
    headset_->on_frame(frame, facts, tools_, scene_, participant_, now);
    if (const auto command = headset_->take_pressed())
        press_plate(*command, now);
    if (const auto wish = headset_->take_wish())
        follow_wish(*wish, now);
    if (const std::string text = headset_->take_note(); !text.empty())
        note(text, now);
    const auto status = participant_.status();
    const bool is_joined = status.phase == client::Participant::Phase::joined;
    // First the warnings, then how to place the table as long as that is to be done, then the news.
    std::string text;
    for (const std::string& part :
         {facts.past, played(now),
          headset_->places_table() ? say(Phrase::how_to_place_table) : std::string(),
          notice_.text(now)})
        if (!part.empty())
            text += (text.empty() ? "" : ". ") + part;
    scene_.set_headset_text(is_joined ? text : say(Phrase::headset_lost_connection));
}

void Viewer::on_headset_space_moved(const std::optional<Pose>& before_from_now) {
    if (headset_)
        headset_->on_space_moved(before_from_now);
}

void Viewer::follow_wish(const MenuRow& wish, TimePoint now) {
    if (wish.action == MenuAction::drawing) {
        choose_next_renderer(now);
    } else if (wish.action == MenuAction::new_brick && scene_.past_moment()) {
        note(say(Phrase::changes_nothing), now);
    } else if (wish.action == MenuAction::new_brick) {
        handling_.make_brick(headset_->head(), participant_);
    } else if (wish.action == MenuAction::live) {
        look_back(Duration(0), now);
    } else if (wish.action == MenuAction::go_to_person) {
        if (const auto place = place_beside(wish.person))
            bring(*place);
    } else if (wish.action == MenuAction::panel) {
        if (wish.panel == Sheet::study)
            study_.put_aside(false);
        open_plate(wish.panel);
    } else {
        headset_wish_ = wish.action;
    }
}

Pose Viewer::own_eye() const {
    constexpr Size any{16, 9};
    return headset_ ? headset_->head().room_from_eye : eye_.view(any).room_from_eye;
}

void Viewer::open_plate(Sheet sheet) {
    plate_ = sheet;
    plate_made_ = {};
    if (sheet == Sheet::none && headset_)
        headset_->show_panels({});
    adjusting_.show(sheet == Sheet::adjust && may(session::Right::adjust));
}

// A panel changes with the session, but not with each picture.
void Viewer::show_plate(TimePoint now) {
    constexpr Duration every = std::chrono::milliseconds(100);
    if (plate_ == Sheet::none || now - plate_made_ < every)
        return;
    plate_made_ = now;
    Facts facts;
    facts.received.status = participant_.status();
    facts.visitors = participant_.visitors();
    facts.past = past(now);
    RoomPanel panel;
    add_sheet(plate_, facts, panel, now);
    plate_commands_ = std::move(panel.commands);
    headset_->show_panels(std::move(panel.panels));
}

void Viewer::press_plate(int command, TimePoint now) {
    plate_made_ = {};
    if (command == close_plate) {
        study_.put_aside(study_.is_aside() || plate_ == Sheet::study);
        open_plate(Sheet::none);
    } else if (command >= 0 && command < int(plate_commands_.size()))
        carry_out(RoomCommand(plate_commands_[std::size_t(command)]), now);
}

void Viewer::draw_headset(const xr::HeadsetFrame& frame, TimePoint now) {
    std::vector<render::EyePicture> eyes;
    for (std::size_t i = 0; i < frame.eyes.size(); ++i) {
        const xr::HeadsetEye& eye = frame.eyes[i];
        eyes.push_back({headset_->eyes()[i], {eye.framebuffer, eye.x, eye.y, eye.size}});
    }
    draw_eyes(headset_->head(), eyes, now);
    if (headset_->vignette() > 0 && !vignette_)
        vignette_ = std::make_unique<render::Vignette>();
    for (const render::EyePicture& eye : eyes)
        if (vignette_)
            vignette_->draw(eye.view, eye.target, headset_->vignette());
}

}  // namespace theatron::viewer
