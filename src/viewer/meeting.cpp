// SPDX-License-Identifier: Apache-2.0
#include "viewer/meeting.h"

#include <algorithm>
#include <utility>

#include "face/expression.h"
#include "phrases/phrase.h"
#include "room/facing.h"
#include "session/room_bytes.h"
#include "viewer/age_text.h"
#include "viewer/cloud_skin.h"
#include "viewer/placed_marks.h"
#include "viewer/voices.h"

namespace theatron::viewer {
namespace {

constexpr double label_above_m = 0.12, label_height_m = 0.03, letter_width = 0.8;

std::optional<Pose> pose_of(const std::optional<wire::PartPose>& part) {
    return part ? std::optional(session::pose_of(*part)) : std::nullopt;
}

// The age of a live person changes all the time: it is drawn with what else changes.
bool same(const room::RoomPerson& a, const room::RoomPerson& b) {
    return a.id == b.id && a.name == b.name && a.head == b.head && a.left_hand == b.left_hand &&
           a.right_hand == b.right_hand && a.is_stale == b.is_stale && a.has_cloud == b.has_cloud &&
           a.has_headset == b.has_headset && a.calls == b.calls && a.points == b.points &&
           a.expression == b.expression && a.own_head == b.own_head && a.skin_gain == b.skin_gain &&
           a.shown_face == b.shown_face && (!a.is_stale || a.age == b.age);
}

room::ShownFace shown_face_of(const wire::FaceExpression& expression) {
    room::ShownFace shown;
    shown.emotions = expression.emotions;
    shown.direct = {expression.jaw_open, expression.blink_left, expression.blink_right};
    if (const auto& all = expression.channels)
        shown.direct = {(*all)[face::jaw_open], (*all)[face::eye_blink_left],
                        (*all)[face::eye_blink_right]};
    return shown;
}

}  // namespace

std::vector<room::RoomPerson> people_of(const client::Participant::Room& room,
                                        const std::map<ParticipantId, wire::PersonPose>& poses,
                                        TimePoint now) {
    std::vector<room::RoomPerson> people;
    for (const auto& [id, object] : room.objects) {
        if (object.kind != session::ObjectKind::person || object.creator == room.self)
            continue;
        const auto facts = session::decode_person(object.properties);
        room::RoomPerson person;
        person.id = object.creator;
        person.name = facts ? facts->name : "";
        if (session::is_recorded(person.id))
            person.name += " (recorded)";
        if (const auto pose = poses.find(person.id); pose != poses.end()) {
            person.head = pose_of(pose->second.head);
            person.left_hand = pose_of(pose->second.left_hand);
            person.right_hand = pose_of(pose->second.right_hand);
            person.points = pose->second.points && person.right_hand;
            person.is_stale = now - pose->second.time > Meeting::stale_after;
            person.calls =
                pose->second.calls && !person.is_stale && !session::is_recorded(person.id);
        }
        people.push_back(std::move(person));
    }
    return people;
}

face::Channels channels_of(const wire::FaceExpression& expression) {
    static_assert(wire::face_channels == face::channel_count &&
                  wire::face_emotions == face::emotion_count);
    if (expression.channels)
        return *expression.channels;
    return face::blend_expressions(
        expression.emotions, {expression.jaw_open, expression.blink_left, expression.blink_right});
}

wire::PartPose part_of(const Pose& pose) {
    const Vec3& p = pose.translation;
    const Quat& q = pose.rotation;
    return {{float(p.x), float(p.y), float(p.z)}, {float(q.w), float(q.x), float(q.y), float(q.z)}};
}

wire::PersonPose pose_of_eye(const Pose& room_from_eye, TimePoint time) {
    // A person looks along -z with y up.
    wire::PersonPose pose;
    pose.time = time;
    pose.head = part_of(room_from_eye * Pose{Quat{0, 1, 0, 0}, {}});
    return pose;
}

bool Meeting::set_speaking(const std::map<ParticipantId, int>& levels_db) {
    std::map<ParticipantId, std::string> meters;
    for (const auto& [id, level_db] : levels_db)
        meters[id] = meter_text(level_db);
    return std::exchange(meters_, meters) != meters;
}

bool Meeting::take(const client::Participant& participant) {
    bool changed = false;
    if (const std::uint64_t version = participant.room_version(); version != version_) {
        version_ = version;
        room_ = participant.room();
        changed = true;
    }
    const TimePoint now = taken_at_ = participant.now();
    if (participant.can_look_back() && participant.status().clock_known &&
        (changed || !past_.knows(now)))
        past_.note(room_.objects, now);
    changed = take_past() || changed;
    changed = case_.take(participant, shown(), changed) || changed;
    auto poses = participant.poses();
    std::erase_if(tracks_, [&](const auto& track) { return !poses.contains(track.first); });
    for (auto& [id, pose] : poses) {
        session::PoseTrack& track = tracks_[id];
        track.add(pose, now);
        pose = *track.at(now);
    }
    headsets_.take(poses, now);
    take_expressions(participant, now);
    changed = own_heads_.take(participant.own_faces()) || changed;
    std::vector<room::RoomPerson> people = people_of(room_, poses, now);
    for (room::RoomPerson& person : people) {
        person.has_cloud = clouds_.contains(person.id);
        person.has_headset = headsets_.has(person.id);
        if (const auto track = expressions_.find(person.id); track != expressions_.end())
            if (const auto expression = track->second.at(now)) {
                person.expression = channels_of(*expression);
                person.shown_face = shown_face_of(*expression);
                if (expression->state == wire::FaceExpression::State::voiced)
                    person.name = say(Phrase::mouth_from_voice, person.name);
                person.own_head = own_heads_.of(person.id);
                if (const auto skin = skins_.find(person.id);
                    person.own_head && skin != skins_.end())
                    person.skin_gain =
                        skin_gain(person.own_head->color(face::HeadPart::skin), skin->second);
            }
        const auto pose = poses.find(person.id);
        if (pose == poses.end())
            continue;
        const double age_ms = to_ms(now - pose->second.time);
        if (person.is_stale || (shows_ages_ && age_ms >= least_told_ms))
            person.age = seen_age(age_ms, !person.is_stale);
    }
    changed =
        changed || !std::equal(people.begin(), people.end(), people_.begin(), people_.end(), same);
    people_ = std::move(people);
    return changed;
}

void Meeting::take_expressions(const client::Participant& participant, TimePoint now) {
    const auto newest = participant.expressions();
    std::erase_if(expressions_, [&](const auto& track) { return !newest.contains(track.first); });
    for (const auto& [id, expression] : newest)
        expressions_[id].add(expression, now);
}

// True if other objects are drawn than before.
bool Meeting::take_past() {
    const bool showed_past = std::exchange(shows_past_, moment_.has_value());
    if (!moment_)
        return showed_past;
    session::RoomObjects then = past_.at(*moment_);
    if (showed_past && then == then_)
        return false;
    then_ = std::move(then);
    return true;
}

bool Meeting::is_moving(TimePoint session_time) const {
    if (std::any_of(expressions_.begin(), expressions_.end(),
                    [&](const auto& track) { return track.second.is_moving(session_time); }))
        return true;
    return std::any_of(tracks_.begin(), tracks_.end(), [&](const auto& track) {
        const auto& teleport = track.second.teleport();
        return track.second.is_moving(session_time) ||
               (teleport && to_seconds(session_time - track.second.delay() - teleport->at) <
                                room::TeleportMarks::effect_s);
    });
}

const render::SceneMesh& Meeting::mesh_of(const room::Brick& brick) {
    const std::tuple key{brick.studs_x, brick.studs_z};
    const auto found = bricks_.find(key);
    return found != bricks_.end()
               ? found->second
               : bricks_.emplace(key, render::SceneMesh(room::make_brick_mesh(brick)))
                     .first->second;
}

void Meeting::add_to(render::SceneFrame& frame, const render::CameraView& view) {
    const Vec3 eye = view.room_from_eye.translation;
    for (const auto& [id, object] : shown()) {
        add_holder(frame, id, object, eye);
        if (object.kind != session::ObjectKind::brick)
            continue;
        const auto brick = room::decode_brick(object.properties);
        if (!brick)
            continue;
        render::SurfaceLook look{room::color_of(ParticipantId{brick->color}), 0, 0.35};
        frame.objects.push_back({&mesh_of(*brick), object.room_from_object, look, false,
                                 render::PickId(std::uint32_t(id))});
    }
    case_.add_to(frame, view);
    if (screens_)
        screens_->add_to(frame);
    std::vector<room::PlacedMark> marks = placed_marks(shown(), case_);
    if (new_mark_)
        append_placed(*new_mark_, false, case_, marks);
    mark_scene_.add_to(frame, marks, view);
    add_teleports(frame);
    const bool has_hands = own_hands_[0] || own_hands_[1];
    if (people_.empty() && !has_hands)
        return;
    if (!avatars_)
        avatars_ = std::make_unique<room::People>();
    std::vector<room::RoomPerson> shown = people_;
    if (has_hands) {
        room::RoomPerson self;
        self.id = room_.self;
        self.left_hand = own_hands_[0];
        self.right_hand = own_hands_[1];
        shown.push_back(std::move(self));
    }
    for (room::RoomPerson& person : shown) {
        if (const auto meter = meters_.find(person.id); meter != meters_.end())
            person.name += " " + meter->second;
        if (shows_past_)
            person.name = say(Phrase::person_now, person.name);
        if (const auto face = faces_.find(person.id); face != faces_.end())
            person.face = face->second;
    }
    avatars_->add_to(frame, shown, view);
}

// The name of another person above what they hold.
void Meeting::add_holder(render::SceneFrame& frame, session::ObjectId id,
                         const session::RoomObject& object, Vec3 eye) {
    // Somebody who holds it now did not yet hold it, or not there, in the past that is shown.
    if (shows_past_ || object.grip.holder == ParticipantId{} || object.grip.holder == room_.self)
        return;
    const std::string text = say(Phrase::holds_this, name_of(object.grip.holder));
    double above_m = label_above_m;
    if (const auto screen = session::decode_shared_screen(object.kind, object.properties))
        above_m += 0.5 * session::place_of(object, *screen).height_m;
    Pose place = room::facing(shown_pose(held_room(), id).translation + Vec3{0, above_m, 0}, eye);
    place.translation =
        place * Vec3{-0.5 * label_height_m * letter_width * double(text.size()), 0, 0};
    frame.texts.push_back({text, place, label_height_m, {235, 240, 240}});
}

void Meeting::add_teleports(render::SceneFrame& frame) {
    const auto marks = [&]() -> const room::TeleportMarks& {
        if (!marks_)
            marks_ = std::make_unique<room::TeleportMarks>();
        return *marks_;
    };
    if (arc_)
        marks().add_arc(frame, *arc_, room::color_of(room_.self));
    for (const auto& [id, track] : tracks_)
        if (const auto& teleport = track.teleport()) {
            const double age_s = to_seconds(taken_at_ - track.delay() - teleport->at);
            if (age_s < 0 || age_s >= room::TeleportMarks::effect_s)
                continue;
            for (const Vec3 head : {teleport->from, teleport->to})
                marks().add_effect(frame, head, room::color_of(id), age_s);
        }
}

std::optional<Meeting::Hit> Meeting::pick(const render::PickRay& ray,
                                          const render::CameraView& view) {
    render::SceneFrame frame;
    add_to(frame, view);
    const auto picked = render::pick(frame, ray);
    if (!picked)
        return std::nullopt;
    return Hit{session::ObjectId(std::uint32_t(picked->id)), *picked};
}

const room::RoomPerson* Meeting::person(ParticipantId id) const {
    for (const room::RoomPerson& person : people_)
        if (person.id == id && person.head)
            return &person;
    return nullptr;
}

std::string Meeting::name_of(ParticipantId id) const {
    for (const room::RoomPerson& person : people_)
        if (person.id == id)
            return person.name;
    return "";
}

}  // namespace theatron::viewer
