// SPDX-License-Identifier: Apache-2.0
#include "flat_view.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "geometry/screen.h"
#include "page_state.h"
#include "session/whose_camera.h"
#include "viewer/meeting.h"
#include "viewer/playing.h"
#include "wire/no_codec.h"

namespace theatron::web {

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
            seen_[camera.description.id] = {session::whose_camera(camera.description, room.objects),
                                            is_screen(camera.calibration)};
    if (!camera_ || !seen_.contains(*camera_)) {
        camera_.reset();
        next_camera();
    }
    if (!camera_)
        shown_.reset();
    ask();
}

// Each connection knows only the wish for all cameras, which is nothing.
void FlatView::ask() {
    const client::Participant::Status status = participant_.status();
    if (!camera_ || status.phase != client::Participant::Phase::joined)
        return;
    Asked wanted{status.joins, *camera_, color_};
    if (asked_ == wanted)
        return;
    const std::string nothing(wire::no_codec);
    participant_.choose_codecs(nothing, nothing);
    participant_.choose_codecs(*camera_, "", color_);
    asked_ = std::move(wanted);
}

bool FlatView::take(TimePoint now) {
    if (const auto status = participant_.status();
        status.phase == client::Participant::Phase::refused && status.joins == 0)
        throw Error(status.problem);
    follow_cameras();
    bool is_new = false;
    for (const receive::CameraFramePtr& frame : participant_.take_frames()) {
        if (frame->camera != camera_ || !frame->color)
            continue;
        const Seen& seen = seen_[frame->camera];
        show(*frame->color, seen.is_screen ? most_screen_width : most_flat_width);
        shown_ = {seen.name, frame->times.captured};
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
    add_people(facts, now);
    return facts;
}

void FlatView::add_people(viewer::Facts& facts, TimePoint now) {
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
    // Ways to people need the room's view.
    for (window::Panel& one : people.panels)
        for (window::PanelRow& row : one.rows)
            std::erase_if(row.buttons, [&](const window::PanelButton& button) {
                return !std::holds_alternative<viewer::Decide>(
                    people.commands[std::size_t(button.command)]);
            });
    viewer::RoomPanel panel;
    (void)study_.take(participant_.study(), now);
    study_.add_panel(panel, now);
    panel = viewer::joined(std::move(panel), people);
    facts.panels = std::move(panel.panels);
    commands_ = std::move(panel.commands);
}

void FlatView::press(int command, TimePoint now) {
    if (command < 0 || command >= int(commands_.size()))
        return;
    if (const auto* press = std::get_if<viewer::StudyPress>(&commands_[std::size_t(command)]))
        if (const auto reply = study_.carry_out(*press, now))
            participant_.reply_to_study(*reply);
    const auto* decision = std::get_if<viewer::Decide>(&commands_[std::size_t(command)]);
    if (decision && removal_.is_meant(*decision, now))
        participant_.manage(decision->action, decision->person, decision->role);
}

nlohmann::json FlatView::state(const viewer::Facts& facts, const std::string& address) const {
    nlohmann::json state = state_of(facts, participant_, address);
    state["pictures"] = pictures_;
    state["flat_camera"] = shown_ ? shown_->camera : "";
    return state;
}

}  // namespace theatron::web
