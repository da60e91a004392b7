// SPDX-License-Identifier: Apache-2.0
#include "flat_marks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "phrases/phrase.h"
#include "session/permissions.h"
#include "viewer/meeting.h"
#include "viewer/pointing_hand.h"
#include "viewer/refusal_text.h"
#include "viewer/tools/grasp.h"
#include "viewer/tools/mark_actions.h"

namespace theatron::web {
namespace {

using nlohmann::json;

constexpr Duration told_every = std::chrono::milliseconds(33);
// Others' pointers move that often; what this person does is drawn at once.
constexpr Duration drawn_every = std::chrono::milliseconds(50);
// A tool that is taken again at once finds the surface there.
constexpr Duration depth_stays = std::chrono::seconds(5);

std::string text_of(Rgb color) {
    char text[8];
    std::snprintf(text, sizeof(text), "#%02x%02x%02x", color.r, color.g, color.b);
    return text;
}

// Shares of the picture to 1e-5: finer than its pixels.
double rounded(double share) {
    return std::round(share * 1e5) / 1e5;
}

json to_json(const viewer::FlatDrawing& drawing) {
    json lines = json::array(), labels = json::array();
    for (const viewer::FlatLine& line : drawing.lines) {
        json pieces = json::array();
        for (const viewer::FlatPiece& piece : line.pieces)
            pieces.push_back({rounded(piece.from.x), rounded(piece.from.y),
                              rounded(piece.from_radius), piece.from_half_widths,
                              rounded(piece.to.x), rounded(piece.to.y), rounded(piece.to_radius),
                              piece.to_half_widths});
        lines.push_back({{"color", text_of(line.color)},
                         {"outline", text_of(render::outline_color(line.color))},
                         {"points", line.points},
                         {"pieces", std::move(pieces)}});
    }
    for (const viewer::FlatLabel& label : drawing.labels)
        labels.push_back({{"text", label.utf8},
                          {"brief", label.brief},
                          {"x", rounded(label.place.x)},
                          {"y", rounded(label.place.y)},
                          {"color", text_of(label.color)},
                          {"rank", int(label.rank)}});
    return {{"lines", std::move(lines)}, {"labels", std::move(labels)}};
}

bool happens(const window::WindowInput& input) {
    return input.grabbed || input.released || !input.keys.empty();
}

}  // namespace

void FlatMarks::show(CameraId camera, const Calibration& calibration, bool measures) {
    receive::CameraFramePtr frame;
    if (shown_ && shown_->camera == camera)
        frame = std::move(shown_->frame);
    else
        tools_.lift();
    shown_ = Shown{camera, calibration, measures, std::move(frame)};
}

void FlatMarks::take(const receive::CameraFramePtr& frame) {
    if (shown_ && frame->camera == shown_->camera && frame->depth.size.area() > 0)
        shown_->frame = frame;
}

std::optional<viewer::FlatPicture> FlatMarks::picture() const {
    if (!measures())
        return std::nullopt;
    return viewer::FlatPicture(shown_->camera, shown_->calibration,
                               shown_->frame ? shown_->frame->depth.view() : DepthView{});
}

void FlatMarks::on_key(const window::KeyPress& key, wire::Role role,
                       std::vector<std::string>& notes) {
    if (key.action == window::Action::marks && session::may(role, session::Right::handle))
        tools_.choose(tools_.chosen() == viewer::ToolKind::none ? viewer::ToolKind::stroke
                                                                : viewer::ToolKind::none);
    const bool goes_back =
        key.action == window::Action::undo_mark || key.action == window::Action::leave;
    if (goes_back && tools_.give_up())
        return;
    if (key.action == window::Action::undo_mark && !viewer::undo_mark(participant_))
        notes.push_back(say(Phrase::no_own_mark));
}

void FlatMarks::step(window::InputQueue& queue, TimePoint now, std::vector<std::string>& notes) {
    follow_room(now);
    const wire::Role role = participant_.status().standing.role;
    do {
        window::WindowInput input = queue.take();
        input.points = input.points && session::may(role, session::Right::point);
        for (const window::KeyPress& key : input.keys)
            on_key(key, role, notes);
        const auto seen = picture();
        tools_.on_input(input, seen ? &*seen : nullptr, measures());
        if (happens(input))
            drawn_ = {};
    } while (queue.has_more());
    for (session::Mark& mark : tools_.take_marks())
        (void)viewer::make_mark(participant_, std::move(mark));
    if (const auto advice = tools_.take_advice())
        notes.push_back(say(*advice));
    while (const auto refusal = participant_.take_room_refusal())
        if (std::string text = viewer::text_of(refusal->second); !text.empty())
            notes.push_back(std::move(text));
    send_pointing(now);
    if (tools_.are_used() || expects_pointing_ || !pointing_.empty())
        needed_ = now;
    wants_depth_ = needed_ != TimePoint{} && now - needed_ < depth_stays;
    // The next time needs newer depth.
    if (shown_ && !wants_depth_)
        shown_->frame.reset();
}

void FlatMarks::follow_room(TimePoint now) {
    if (participant_.room_version() != room_.version) {
        room_ = participant_.room();
        marks_.clear();
        for (const auto& [id, object] : room_.objects)
            if (object.kind == session::ObjectKind::mark)
                if (auto mark = session::decode_mark(object.properties))
                    marks_.push_back(std::move(*mark));
    }
    pointing_ = viewer::people_of(room_, participant_.poses(), participant_.session_time(now));
    std::erase_if(pointing_,
                  [](const room::RoomPerson& person) { return !person.points || person.is_stale; });
}

// The hand alone: the person has no place in the room.
void FlatMarks::send_pointing(TimePoint now) {
    const auto& ray = tools_.pointing();
    if (!ray && !told_pointing_)
        return;
    if (ray && now - told_ < told_every)
        return;
    told_ = now;
    told_pointing_ = ray.has_value();
    wire::PersonPose pose;
    pose.time = participant_.session_time(now);
    if (ray)
        pose.right_hand = viewer::part_of(viewer::hand_on(*ray));
    pose.points = ray.has_value();
    participant_.send_pose(pose);
}

viewer::FlatDrawing FlatMarks::drawing() const {
    viewer::FlatDrawing drawing;
    // A mark of the room means nothing over a screen, and a length would be taken for one of it.
    const auto seen = picture();
    if (!seen)
        return drawing;
    for (const session::Mark& mark : marks_)
        add_mark(mark, *seen, drawing);
    if (const session::Mark* begun = tools_.drawn())
        if (const auto preview = viewer::preview_of(room_, *begun))
            add_mark(*preview, *seen, drawing);
    for (const room::RoomPerson& person : pointing_)
        if (const auto point = seen->surface_at(viewer::grip_of_hand(*person.right_hand).ray))
            add_pointer(person.id, person.name, point->place, *seen, drawing);
    if (tools_.pointed())
        add_pointer(room_.self, "", *tools_.pointed(), *seen, drawing);
    return drawing;
}

std::string FlatMarks::take_drawing(TimePoint now) {
    if (!tools_.are_used() && now - drawn_ < drawn_every)
        return "";
    drawn_ = now;
    std::string made = to_json(drawing()).dump(-1, ' ', false, json::error_handler_t::replace);
    if (made == drawing_)
        return "";
    drawing_ = made;
    return made;
}

}  // namespace theatron::web
