// SPDX-License-Identifier: Apache-2.0
#include "flat_view.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "geometry/screen.h"
#include "page_state.h"
#include "phrases/phrase.h"
#include "session/shared_screen.h"
#include "session/whose_camera.h"
#include "viewer/meeting.h"
#include "viewer/panels/tool_panel.h"
#include "viewer/playing.h"
#include "viewer/screen_panel.h"
#include "wire/no_codec.h"

namespace theatron::web {
namespace {

constexpr const char* depth_codec = "strata";

// Buttons of other commands need the room's view.
template <class Command>
void keep_buttons(viewer::RoomPanel& panel) {
    for (window::Panel& one : panel.panels)
        for (window::PanelRow& row : one.rows)
            std::erase_if(row.buttons, [&](const window::PanelButton& button) {
                return !std::holds_alternative<Command>(
                    panel.commands[std::size_t(button.command)]);
            });
}

}  // namespace

client::Participant::Options FlatView::options(client::Participant::Options join) {
    // Nothing until a camera is known: then ask() does.
    join.depth_codec = join.color_codec = wire::no_codec;
    join.takes_color_alone = true;
    join.draws_flat = true;
    join.delivery.max_kbit_per_s = most_kbit_per_s;
    join.keeps_cases = false;  // nothing of them is drawn
    return join;
}

void FlatView::next_camera() {
    auto next = camera_ ? seen_.upper_bound(*camera_) : seen_.begin();
    if (next == seen_.end())
        next = seen_.begin();
    camera_ = next == seen_.end() ? std::nullopt : std::optional(next->first);
    ask();
}

void FlatView::follow_cameras() {
    std::uint64_t generation = 0;
    seen_.clear();
    const auto room = participant_.room();
    for (const auto& camera : participant_.cameras(generation))
        if (camera.description.has_color)
            seen_[camera.description.id] = {
                session::whose_camera(camera.description, room.objects),
                is_screen(camera.calibration),
                camera.calibration.depth.size.area() > 0 && !is_screen(camera.calibration),
                camera.calibration};
    if (!camera_ || !seen_.contains(*camera_)) {
        camera_.reset();
        next_camera();
    }
    if (!camera_)
        shown_.reset();
    show_marks();
    ask();
}

// Each connection knows only the wish for all cameras, which is nothing.
void FlatView::ask() {
    const client::Participant::Status status = participant_.status();
    if (!camera_ || status.phase != client::Participant::Phase::joined)
        return;
    Asked wanted{status.joins, *camera_, color_, seen_[*camera_].measures && marks_.wants_depth()};
    if (asked_ == wanted)
        return;
    const std::string nothing(wire::no_codec);
    participant_.choose_codecs(nothing, nothing);
    participant_.choose_codecs(*camera_, wanted.depth ? depth_codec : "", color_);
    wire::ChooseDelivery goal = client::Participant::Options().delivery;
    goal.max_kbit_per_s = wanted.depth ? most_kbit_per_s_with_depth : most_kbit_per_s;
    participant_.choose_delivery(goal);
    asked_ = std::move(wanted);
}

bool FlatView::take(TimePoint now) {
    if (const auto status = participant_.status();
        status.phase == client::Participant::Phase::refused && status.joins == 0)
        throw Error(status.problem);
    follow_cameras();
    bool is_new = false;
    for (const receive::CameraFramePtr& frame : participant_.take_frames()) {
        marks_.take(frame);
        if (frame->camera != camera_ || !frame->color)
            continue;
        const Seen& seen = seen_[frame->camera];
        show(*frame->color, seen.is_screen ? most_screen_width : most_flat_width);
        shown_ = {frame->camera, seen.name, frame->times.captured};
        is_new = true;
    }
    if (!is_new)
        return false;
    ++pictures_;
    notice_.begin(now);
    drawn_.add(now);
    return true;
}

void FlatView::show(const ColorImage& color, int most_width) {
    const int step = (color.size.width + most_width - 1) / most_width;
    size_ = {color.size.width / step, color.size.height / step};
    pixels_.resize(4 * size_.area());
    std::byte* to = pixels_.data();
    for (int y = 0; y < size_.height; ++y) {
        const Rgb* from = color.view().row(y * step);
        for (int x = 0; x < size_.width; ++x, from += step) {
            *to++ = std::byte(from->r);
            *to++ = std::byte(from->g);
            *to++ = std::byte(from->b);
            *to++ = std::byte(255);
        }
    }
}

void FlatView::note(const std::string& text, TimePoint now) {
    notice_.say(text, now);
}

viewer::Facts FlatView::facts(TimePoint now) {
    viewer::Facts facts;
    facts.received = client::figures_of(participant_);
    // That little comes is this view's own wish.
    facts.received.status.delivery = {};
    const auto room = participant_.room();
    for (client::CameraFigures& one : facts.received.cameras)
        one.camera.description.name = session::whose_camera(one.camera.description, room.objects);
    facts.has_picture = shown_.has_value();
    const TimePoint session_time = participant_.session_time(now);
    if (shown_ && facts.received.status.clock_known)
        facts.age_ms = std::max(to_ms(session_time - shown_->captured), 0.0);
    if (const auto playback = participant_.playback())
        facts.played = viewer::playback_text(*playback, session_time);
    facts.drawn_per_second = drawn_.per_second(now);
    facts.most_drawn_per_second = pictures_per_second;
    facts.way.renderer = "flat";
    facts.notice = notice_.text(now);
    facts.visitors = participant_.visitors();
    add_panels(facts, now);
    return facts;
}

// The picture's camera, until there is a picture of the next one.
void FlatView::show_marks() {
    const auto shown = shown_ ? seen_.find(shown_->id) : seen_.end();
    if (shown == seen_.end())
        marks_.show_nothing();
    else
        marks_.show(shown->first, shown->second.calibration, shown->second.measures);
}

std::string FlatView::step(window::InputQueue& input, TimePoint now) {
    std::vector<std::string> notes;
    marks_.step(input, now, notes);
    for (const std::string& text : notes)
        note(text, now);
    if (!marks_.is_drawing())
        notice_.take_back(say(Phrase::press_at_other_end));
    ask();
    return marks_.take_drawing(now);
}

void FlatView::add_panels(viewer::Facts& facts, TimePoint now) {
    const auto room = participant_.room();
    const wire::Role role = facts.received.status.standing.role;
    viewer::RoomPanel people = viewer::room_panel(
        {.room = room,
         .people = viewer::people_of(room, participant_.poses(), participant_.session_time(now)),
         .places = {},
         .followed = {},
         .is_operator = role == wire::Role::operator_,
         .visitors = facts.visitors,
         .asked = removal_.asked(now)});
    keep_buttons<viewer::Decide>(people);
    viewer::RoomPanel panel;
    (void)study_.take(participant_.study(), now);
    study_.add_panel(panel, now);
    panel = viewer::joined(std::move(panel), people);
    add_screens(facts, panel, now);
    if (marks_.chosen() != viewer::ToolKind::none)
        viewer::add_tool_panel({marks_.chosen(), false, false, role == wire::Role::operator_},
                               panel);
    facts.panels = std::move(panel.panels);
    commands_ = std::move(panel.commands);
}

// Each shared screen, with the way to its picture; and the offer of a new one.
void FlatView::add_screens(const viewer::Facts& facts, viewer::RoomPanel& panel, TimePoint now) {
    const auto room = participant_.room();
    screen_offer_.follow(room.objects, room.self, now);
    if (screen_offer_.is_open(now))
        panel.panels.push_back({say(Phrase::shared_screen), {screen_offer_.row(panel, now)}});
    viewer::RoomPanel screens;
    viewer::add_screen_panel({&room.objects, room.self, facts.received.status.standing.role, {}},
                             screens);
    keep_buttons<viewer::ShowScreen>(screens);
    panel = viewer::joined(std::move(panel), screens);
}

void FlatView::press(int command, TimePoint now) {
    if (command < 0 || command >= int(commands_.size()))
        return;
    const viewer::RoomCommand pressed = commands_[std::size_t(command)];
    std::visit([&](const auto& one) { on(one, now); }, pressed);
}

void FlatView::on(const viewer::StudyPress& press, TimePoint now) {
    if (const auto reply = study_.carry_out(press, now))
        participant_.reply_to_study(*reply);
}

void FlatView::on(const viewer::ChangeMarks& change, TimePoint now) {
    if (!change.change(participant_))
        note(say(Phrase::no_such_mark), now);
}

void FlatView::on(const viewer::Decide& decision, TimePoint now) {
    if (removal_.is_meant(decision, now))
        participant_.manage(decision.action, decision.person, decision.role);
}

void FlatView::on(const viewer::ShowScreen& shown, TimePoint now) {
    screen_offer_.close(shown.screen);
    const auto screen = session::shared_screen_of(participant_.room().objects, shown.screen);
    if (!screen || !screen->camera || !seen_.contains(*screen->camera))
        return note(say(Phrase::not_in_room_any_more), now);
    camera_ = screen->camera;
    ask();
}

nlohmann::json FlatView::state(const viewer::Facts& facts, const std::string& address) const {
    nlohmann::json state = state_of(facts, participant_, address);
    state["pictures"] = pictures_;
    state["flat_camera"] = shown_ ? shown_->camera : "";
    state["draws"] = marks_.is_drawing();
    return state;
}

}  // namespace theatron::web
