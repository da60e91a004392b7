// SPDX-License-Identifier: Apache-2.0
#include "or_screen/or_screen.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "phrases/phrase.h"
#include "room/mark_shape.h"
#include "room/people.h"
#include "room/srgb.h"
#include "session/room_bytes.h"
#include "session/whose_camera.h"
#include "viewer/placed_marks.h"
#include "viewer/playing.h"

namespace theatron::or_screen {
namespace {

constexpr Duration facts_every = std::chrono::milliseconds(250);
constexpr Duration room_every = std::chrono::milliseconds(100);
constexpr int room_part = 4;  // of the time: the room is drawn in one part of five
constexpr Rgb room_ground{24, 26, 30};
// Where nobody points: the middle of the operating table (docs/room.md).
constexpr Vec3 table{0, 1, 0};

// The clouds in the small picture of the room need fewer points.
constexpr int room_depth_step = 2;

// The number of a pin and the length of a distance. The author is known by the colour.
std::string label_of(session::Mark mark) {
    if (mark.kind != session::MarkKind::pin && mark.kind != session::MarkKind::distance)
        return "";
    mark.initials.clear();
    return room::label_of(mark);
}

viewer::RoomChoice shown_room() {
    return {true, render::SceneQuality::low, false};
}

}  // namespace

OrScreen::OrScreen() : scene_(shown_room()) {}

bool OrScreen::step(client::Participant& participant, const std::set<ParticipantId>& speaking,
                    Size screen, TimePoint now) {
    scene_.set_depth_step(room_depth_step);
    const std::vector<CameraId> updated = scene_.take(participant);
    const bool meeting = scene_.take_meeting(participant);
    const bool fading = scene_.fade(participant, now);
    room_changed_ = room_changed_ || !updated.empty() || meeting || fading;
    bool changed = meeting || screen != screen_;
    screen_ = screen;

    const bool facts = now >= next_facts_;
    if (facts) {
        next_facts_ = now + facts_every;
        figures_.clear();
        live_.clear();
        for (client::CameraFigures& one : client::figures_of(participant).cameras) {
            const CameraId id = one.camera.description.id;
            one.camera.description.name =
                session::whose_camera(one.camera.description, scene_.meeting().room().objects);
            if (one.camera.state.condition == wire::CameraCondition::live)
                live_.insert(id);
            figures_.emplace(id, std::move(one));
        }
        choose_camera(speaking, now);
        changed = true;
    }
    if (camera_ && std::find(updated.begin(), updated.end(), *camera_) != updated.end())
        changed = true;
    take_picture();
    take_slice();
    point();
    if (facts || meeting)
        describe(participant, speaking, now);
    layout_ = layout({screen_, content_.picture, content_.people.size() + content_.people_left_out,
                      content_.slice.has_value()});
    return changed || (room_changed_ && now >= next_room_);
}

std::vector<CameraScore> OrScreen::scores_for(const std::vector<Vec3>& places) const {
    std::vector<CameraScore> scores;
    for (const auto& [id, frame] : scene_.newest())
        if (const auto known = scene_.calibrations().find(id);
            known != scene_.calibrations().end() && frame->color)
            scores.push_back(
                {id, live_.contains(id), score_of(known->second, frame->depth.view(), places)});
    return scores;
}

void OrScreen::choose_camera(const std::set<ParticipantId>& speaking, TimePoint now) {
    std::vector<Vec3> of_speakers, of_all;
    for (const auto& [person, place] : pointed_) {
        of_all.push_back(place);
        if (speaking.contains(person))
            of_speakers.push_back(place);
    }
    std::vector<CameraScore> scores;
    // The first of these that some camera sees.
    for (const std::vector<Vec3>& places : {of_speakers, of_all, {table}}) {
        scores = scores_for(places);
        if (std::any_of(scores.begin(), scores.end(),
                        [](const CameraScore& one) { return one.score > 0; }))
            break;
    }
    camera_ = choice_.choose(scores, now);
}

void OrScreen::take_picture() {
    const auto newest = camera_ ? scene_.newest().find(*camera_) : scene_.newest().end();
    const receive::CameraFramePtr frame =
        newest == scene_.newest().end() ? nullptr : newest->second;
    if (frame == frame_)
        return;
    frame_ = frame;
    content_.picture = frame_ && frame_->color ? frame_->color->size : Size{};
    if (content_.picture.area() > 0)
        picture_.set(frame_->color->view());
}

// The slice of the open case's screen, drawn again if it is another one.
void OrScreen::take_slice() {
    const viewer::CaseScene& scene = scene_.meeting().case_scene();
    const medical::Volume* volume = scene.monitor().volume();
    const auto& room = scene.in_room();
    if (!volume || !room || !room->screen) {
        slice_of_ = nullptr;
        slice_shown_.reset();
        slice_plane_.reset();
        content_.slice.reset();
        return;
    }
    const session::CaseScreen& wanted = room->screen->facts;
    if (volume == slice_of_ && slice_shown_ == wanted)
        return;
    const viewer::SlicePicture slice = viewer::slice_picture(*volume, wanted);
    slice_.set(slice.picture.view());
    slice_plane_ = slice.plane;
    slice_of_ = volume;
    slice_shown_ = wanted;
    const medical::SharedCase& about = *scene.content()->description;
    content_.slice =
        viewer::slice_texts(slice.plane, wanted, about.name, about.series[wanted.series].name);
}

std::optional<Vec2> OrScreen::slice_pixel(Vec3 place) const {
    const viewer::CaseScene& scene = scene_.meeting().case_scene();
    const auto& room = scene.in_room();
    if (!slice_plane_ || !room || !room->screen)
        return std::nullopt;
    // A pointer ends on the picture, not somewhere before or behind it.
    constexpr double near_m = 0.03;
    const session::RoomObject& object = room->screen->object;
    if (std::abs((inverse(object.room_from_object) * place).z) > near_m * object.scale)
        return std::nullopt;
    const auto patient = scene.monitor().patient_point(*room, place);
    return patient ? std::optional(medical::pixel_of(*slice_plane_, *patient)) : std::nullopt;
}

PicturePlace OrScreen::in_picture(Vec3 place) const {
    const auto known = camera_ ? scene_.calibrations().find(*camera_) : scene_.calibrations().end();
    if (!frame_ || content_.picture.area() == 0 || known == scene_.calibrations().end())
        return {};
    return place_in_picture(known->second, frame_->depth.view(), place);
}

void OrScreen::point() {
    content_.pointers.clear();
    content_.slice_pointers.clear();
    pointed_.clear();
    const auto& people = scene_.meeting().people();
    if (std::none_of(people.begin(), people.end(), [](const auto& one) { return one.points; }))
        return;
    for (const room::Pointer& pointer : scene_.pointers(room_view())) {
        if (!pointer.reach_m)
            continue;
        const Vec3 place = pointer.from + pointer.direction * *pointer.reach_m;
        PointerMark mark{pointer.id,
                         session::initials_of(pointer.name),
                         room::srgb_of(room::color_of(pointer.id)),
                         {}};
        if (const auto pixel = slice_pixel(place)) {
            mark.place = {Sight::visible, *pixel};
            content_.slice_pointers.push_back(mark);
            continue;
        }
        pointed_.emplace_back(pointer.id, place);
        mark.place = in_picture(place);
        if (mark.place.sight != Sight::outside)
            content_.pointers.push_back(mark);
    }
}

void OrScreen::describe(client::Participant& participant, const std::set<ParticipantId>& speaking,
                        TimePoint) {
    const client::Participant::Status status = participant.status();
    const ScreenMessage message = message_of(status);
    content_.message = message.text;
    content_.detail = message.detail;
    content_.camera.clear();
    content_.age.clear();
    content_.warning.clear();
    content_.playback.clear();
    content_.age_warns = false;
    const auto known = camera_ ? figures_.find(*camera_) : figures_.end();
    // Cameras of participants are not the host's recording.
    if (const auto playback = participant.playback();
        playback && known != figures_.end() &&
        known->second.camera.description.publisher == ParticipantId{})
        content_.playback = viewer::playback_text(*playback, participant.now());
    if (known != figures_.end() && frame_ && status.clock_known) {
        const double age_ms = to_ms(participant.now() - frame_->times.captured);
        // Late colour belongs to an earlier moment than the frame.
        describe_picture(known->second, std::max(age_ms, known->second.color.age_now_ms), content_);
    }
    client::ParticipantFigures recorded;
    for (const client::Participant::Recording& one : participant.recordings())
        recorded.recordings.push_back({one.name, participant.now() - one.since});
    content_.recorded = client::recorded_text(recorded);
    content_.written = written_texts(participant.chat(), participant.now());
    describe_people(participant, speaking);
    describe_marks();
    for (HeadMark& head : content_.heads)
        head.speaks = speaking.contains(head.id);
}

void OrScreen::describe_people(client::Participant& participant,
                               const std::set<ParticipantId>& speaking) {
    const client::Participant::Room& room = scene_.meeting().room();
    const auto poses = participant.poses();
    std::vector<PersonNow> people;
    for (const auto& [id, object] : room.objects) {
        if (object.kind != session::ObjectKind::person || object.creator == room.self)
            continue;
        const auto facts = session::decode_person(object.properties);
        PersonNow person;
        person.id = object.creator;
        person.is_recorded = session::is_recorded(id);
        if (facts) {
            person.name = facts->name;
            person.role = facts->role;
            person.muted = facts->muted;
            person.hand_raised = facts->hand_raised && !person.is_recorded;
        }
        person.speaks = speaking.contains(person.id);
        if (const auto pose = poses.find(person.id); pose != poses.end()) {
            person.pose_age_ms = to_ms(participant.now() - pose->second.time);
            person.points = pose->second.points && pose->second.right_hand;
        }
        const auto is_of = [&](const PointerMark& mark) { return mark.id == person.id; };
        const auto& on_picture = content_.pointers;
        const auto& on_slice = content_.slice_pointers;
        const auto shown = std::find_if(on_picture.begin(), on_picture.end(), is_of);
        person.points_at_images = std::any_of(on_slice.begin(), on_slice.end(), is_of);
        person.pointed = shown != on_picture.end() ? shown->place.sight : Sight::outside;
        people.push_back(std::move(person));
    }
    const std::size_t places = Layout::most_cards;
    content_.is_alone = people.empty();
    content_.people_left_out = people.size() > places ? people.size() - (places - 1) : 0;
    content_.people = cards_of(people, content_.people_left_out > 0 ? places - 1 : places);
}

void OrScreen::describe_marks() {
    content_.marks.clear();
    for (const room::PlacedMark& placed :
         viewer::placed_marks(scene_.meeting().room().objects, scene_.meeting().case_scene())) {
        // Those on a slice are seen on the monitor.
        if (placed.mark.surface == session::MarkedSurface::slice || placed.mark.points.empty())
            continue;
        PictureMark mark{placed.mark.kind,
                         label_of(placed.mark),
                         room::srgb_of(room::color_of(ParticipantId{placed.mark.color})),
                         {}};
        bool is_seen = false;
        for (const session::MarkPoint& point : placed.mark.points) {
            mark.points.push_back(
                in_picture(placed.room_from_points * (point.position * placed.scale)));
            is_seen = is_seen || mark.points.back().sight != Sight::outside;
        }
        if (is_seen)
            content_.marks.push_back(std::move(mark));
    }
}

// In the picture of the room that is drawn now.
void OrScreen::describe_heads() {
    const std::vector<HeadMark> before = std::exchange(content_.heads, {});
    const render::CameraView view = room_view();
    const Pose eye_from_room = inverse(view.room_from_eye);
    for (const room::RoomPerson& person : scene_.meeting().people()) {
        if (!person.head)
            continue;
        const Vec3 head = eye_from_room * person.head->translation;
        if (head.z < view.near_m)
            continue;
        // People beside the picture stand at its edge.
        const auto share = [](double value, double from, double to) {
            return std::clamp((value - from) / (to - from), 0.0, 1.0);
        };
        const auto known = std::find_if(before.begin(), before.end(),
                                        [&](const HeadMark& mark) { return mark.id == person.id; });
        content_.heads.push_back({person.id,
                                  session::initials_of(person.name),
                                  room::srgb_of(room::color_of(person.id)),
                                  known != before.end() && known->speaks,
                                  {share(head.x / head.z, view.left, view.right),
                                   share(head.y / head.z, view.top, view.bottom)}});
    }
}

Size OrScreen::room_size() const {
    constexpr int least = 16;  // before the first layout
    return {std::max(int(layout_.room.width), least), std::max(int(layout_.room.height), least)};
}

// From above, from the side of the cameras, so that left and right are those of their pictures. The
// taller the picture, the steeper.
render::CameraView OrScreen::room_view() const {
    constexpr double near_m = 1.5, far_m = 2.4, height_m = 2.75;
    constexpr double shown_radius_m = 1.55;  // around the table
    constexpr Vec3 target{0, 1.05, 0};
    Vec3 side{0, 0, 0};
    for (const auto& [id, calibration] : scene_.calibrations())
        if (calibration.registered) {
            const Vec3 at = calibration.room_from_camera.translation;
            side = side + Vec3{at.x, 0, at.z};
        }
    side = length(side) > 0.3 ? normalized(side) : Vec3{0, 0, 1};
    const Size size = room_size();
    const double aspect = double(size.width) / size.height;
    Vec3 eye = side * std::clamp(far_m * aspect, near_m, far_m);
    eye.y = height_m;
    if (const auto& space = scene_.free_space())
        eye = room::kept_inside(*space, eye);
    const double half = shown_radius_m / length(eye - target) / std::min(1.0, aspect);
    const double vertical_degrees = 2 * std::atan(half) * 180 / std::numbers::pi;
    return render::view_towards(eye, target, std::min(vertical_degrees, 110.0), size);
}

void OrScreen::draw_room(TimePoint now) {
    const Size size = room_size();
    const bool is_new = !room_ || room_->size() != size;
    room_drawn_ = is_new || (room_changed_ && now >= next_room_);
    if (!room_drawn_)
        return;
    if (is_new)
        room_.emplace(size);
    room_->clear(room_ground);
    scene_.draw(room_view(), room_->target(), "mesh");
    describe_heads();
    room_changed_ = false;
}

void OrScreen::draw(const render::DrawTarget& target, TimePoint now) {
    draw_room(now);
    const Vec2 by = drift(now);
    drawing_.draw(
        content_, layout_, {std::round(by.x * layout_.letter), std::round(by.y * layout_.letter)},
        {&picture_, room_ ? &room_->color() : nullptr, content_.slice ? &slice_ : nullptr}, target);
}

void OrScreen::on_drawn(Duration took, TimePoint now) {
    if (room_drawn_)
        next_room_ = now + std::max(room_every, room_part * took);
}

}  // namespace theatron::or_screen
