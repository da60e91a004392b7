// SPDX-License-Identifier: Apache-2.0
#include "room_lines.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/log.h"
#include "base/steady_clock.h"
#include "export/mark_json.h"
#include "export/screen_json.h"
#include "face/emotion.h"
#include "room/bricks.h"
#include "session/case_objects.h"
#include "session/room_text.h"
#include "session/shared_screen.h"
#include "viewer/meeting.h"
#include "viewer/refusal_text.h"
#include "viewer/screen_panel.h"

namespace theatron::app {
namespace {

namespace request = session::request;

constexpr double same_place_m = 1e-6;
const char* const needs_places =
    "It needs numbers of metres, none beyond 1000: for example 'brick 0.2 1.25 0.3'.";
const char* const not_joined = "The room is not known yet.";
constexpr Duration refusals_interval = std::chrono::seconds(1);
constexpr Duration pose_repeated_after = std::chrono::milliseconds(500);

bool read(std::istream& words, Vec3& place) {
    words >> place.x >> place.y >> place.z;
    for (const double value : {place.x, place.y, place.z})
        if (!words || !(std::abs(value) <= wire::max_pose_distance))
            return false;
    return true;
}

// The pose of a head or a hand at `place` that looks or points at `at`: y up, -z forward.
Pose towards(Vec3 place, Vec3 at) {
    const bool is_vertical = length(cross(at - place, {0, 1, 0})) < same_place_m;
    return look_at(place, at, is_vertical ? Vec3{0, 0, -1} : Vec3{0, 1, 0}) *
           Pose{Quat{0, 1, 0, 0}, {}};
}

// The state of the tracker and the strongest emotion, as it is drawn; whether the person's own face
// has come.
nlohmann::json face_json(const wire::FaceExpression& shown, bool has_own) {
    const auto strongest = std::max_element(shown.emotions.begin(), shown.emotions.end());
    using State = wire::FaceExpression::State;
    return {{"state", shown.state == State::lost ? "lost" : "tracked"},
            {"mouth_guessed", shown.state == State::voiced},
            {"emotion", face::emotion_names[std::size_t(strongest - shown.emotions.begin())]},
            {"channels", shown.channels.has_value()},
            {"own", has_own}};
}

}  // namespace

const char* RoomLines::help() {
    return "'stand X Y Z AT_X AT_Y AT_Z', 'point [X Y Z AT_X AT_Y AT_Z]', 'call', 'brick X Y Z',\n"
           "'grab NUMBER', 'move X Y Z [DEGREES]', 'width METRES' of a held screen, 'release',\n"
           "'give NAME', 'remove', 'pin NUMBER', 'unpin NUMBER', 'end NUMBER' of a shared screen "
           "(metres)";
}

void RoomLines::stand(const Pose& room_from_head) {
    pose_.head = viewer::part_of(room_from_head);
    room_from_head_ = room_from_head;
}

bool RoomLines::obey(const std::string& line, client::Participant& participant) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    for (const char* known : {"stand", "point", "call", "brick", "grab", "move", "width", "release",
                              "give", "remove", "pin", "unpin", "end"})
        if (what == known) {
            if (const std::string problem = change(what, words, participant); !problem.empty())
                log::say("'" + line + "': " + problem);
            return true;
        }
    return false;
}

std::string RoomLines::change(const std::string& what, std::istream& words,
                              client::Participant& participant) {
    if (what == "point" && (words >> std::ws).eof()) {
        pose_.points = false;
        pose_.right_hand.reset();
        sent_ = {};
        return "";
    }
    if (what == "stand" || what == "point") {
        Vec3 place, at;
        if (!read(words, place) || !read(words, at))
            return needs_places;
        if (length(at - place) < same_place_m)
            return "The two places are the same.";
        if (what == "stand")
            stand(towards(place, at));
        else
            pose_.right_hand = viewer::part_of(towards(place, at));
        pose_.points = pose_.points || what == "point";
        sent_ = {};
        return "";
    }
    if (what == "call") {
        if (!pose_.head)
            return "Nobody knows where you are; 'stand' comes first.";
        calls_until_ = steady_now() + viewer::Meeting::called_for;
        sent_ = {};
        return "";
    }
    if (participant.room().objects.empty())
        return not_joined;
    if (what == "brick") {
        Vec3 place;
        if (!read(words, place))
            return needs_places;
        participant.ask_room(request::Create{
            session::ObjectKind::brick, {{}, place}, 1, room::encode_brick({4, 2, next_color_++})});
        return "";
    }
    if (what == "pin" || what == "unpin" || what == "end") {
        std::uint32_t number = 0;
        words >> number;
        using What = viewer::ChangeScreen::What;
        const What change = what == "pin" ? What::pin : what == "unpin" ? What::unpin : What::end;
        return words && viewer::change_screen({change, session::ObjectId(number)}, participant)
                   ? ""
                   : "There is no shared screen of this number; --json lists them under \"room\".";
    }
    return handle(what, words, participant);
}

std::string RoomLines::handle(const std::string& what, std::istream& words,
                              client::Participant& participant) {
    const client::Participant::Room now = participant.room();
    const auto people = viewer::people_of(now, {}, participant.now());
    const auto open = session::case_in_room(now.objects);
    const viewer::HoldRoom room{now.self, now.objects, people, open};
    const auto pass = [&](const viewer::HoldStep& step) {
        viewer::ask(step, participant);
        return step.requests.empty() ? step.note : "";
    };
    if (what == "grab") {
        std::uint32_t number = 0;
        words >> number;
        const auto found = now.objects.find(session::ObjectId(number));
        if (!words || found == now.objects.end() ||
            found->second.kind == session::ObjectKind::person)
            return "There is no object of this number; --json lists them under \"room\".";
        return pass(hold_.take(room, found->first, true));
    }
    if (!hold_.adopt(room))
        return "Nothing is held; 'grab NUMBER' comes first.";
    const session::RoomObject& object = now.objects.at(hold_.object());
    if (what == "move") {
        Vec3 place;
        double degrees = 0;
        if (!read(words, place))
            return needs_places;
        words >> degrees;
        Pose pose{rotation_about({0, 1, 0}, radians_of(degrees)), place};
        // A screen has y down; unturned it faces the reader at +z.
        if (session::is_shared_screen(object))
            pose = pose * Pose{usual_screen_place.rotation, {}};
        hold_.put(pose);
    }
    if (what == "width") {
        double width_m = 0;
        words >> width_m;
        if (!words || !session::is_shared_screen(object) || !hold_.set_scale(room, width_m))
            return "A shared screen that is held can be from 0.1 to 10 m wide.";
    }
    if (what == "move" || what == "width") {
        const viewer::HoldMove move = *hold_.move(room);
        if (participant.move_object(move.object, move.room_from_object, move.scale))
            return "";
        hold_.forget();
        return "The object is no longer held.";
    }
    if (what == "give") {
        std::string name;
        std::getline(words >> std::ws, name);
        for (const auto& person : people)
            if (person.name == name)
                return pass(hold_.give(room, person.id));
        return "Nobody of this name is here.";
    }
    return pass(what == "release" ? hold_.let_go(room) : hold_.remove(room));
}

// At most one line a second, however many there are.
void RoomLines::print_refusals(client::Participant& participant, TimePoint now) {
    while (const auto refusal = participant.take_room_refusal()) {
        ++refused_;
        refusal_ = viewer::text_of(refusal->second);
    }
    if (refused_ == 0 || now - refusals_printed_ < refusals_interval)
        return;
    refusals_printed_ = now;
    log::say((refused_ == 1 ? "A change of the room was refused: "
                            : std::to_string(refused_) +
                                  " changes of the room were refused, the last one: ") +
             refusal_ + ".");
    refused_ = 0;
}

void RoomLines::on_tick(client::Participant& participant) {
    // Also when the hand is gone again, so that the others see that.
    was_seen_ = was_seen_ || pose_.head || pose_.right_hand;
    const TimePoint now = steady_now();
    print_refusals(participant, now);
    if (!was_seen_ || now - sent_ < pose_repeated_after || !participant.status().clock_known)
        return;
    sent_ = now;
    pose_.time = participant.now();
    pose_.calls = now < calls_until_;
    participant.send_pose(pose_);
}

nlohmann::json room_json(const client::Participant& participant) {
    const auto room = participant.room();
    const auto poses = participant.poses();
    const auto expressions = participant.expressions();
    const auto own_faces = participant.own_faces();
    nlohmann::json people = nlohmann::json::array(), objects = nlohmann::json::array();
    for (const auto& [id, object] : room.objects) {
        if (object.kind == session::ObjectKind::person) {
            if (const auto facts = session::decode_person(object.properties)) {
                people.push_back(
                    {{"id", std::uint32_t(object.creator)},
                     {"name", facts->name},
                     {"records", facts->records},
                     {"recorded", session::is_recorded(id)},
                     {"calls", poses.contains(object.creator) && poses.at(object.creator).calls},
                     {"points", poses.contains(object.creator) && poses.at(object.creator).points},
                     {"role", wire::text_of(facts->role)},
                     {"muted", facts->muted},
                     {"voice_recorded", facts->voice_recorded},
                     {"hand_raised", facts->hand_raised}});
                if (const auto found = expressions.find(object.creator); found != expressions.end())
                    people.back()["face"] =
                        face_json(found->second, own_faces.contains(object.creator));
                if (const auto pose = poses.find(object.creator); pose != poses.end())
                    for (const auto& [name, part] : {std::pair{"head", &pose->second.head},
                                                     {"left_hand", &pose->second.left_hand},
                                                     {"right_hand", &pose->second.right_hand}})
                        if (*part)
                            people.back()[name] = (*part)->position;
            }
            continue;
        }
        const Vec3& p = object.room_from_object.translation;
        objects.push_back({{"id", std::uint32_t(id)},
                           {"kind", session::text_of(object.kind)},
                           {"recorded", session::is_recorded(id)},
                           {"creator", std::uint32_t(object.creator)},
                           {"held_by", std::uint32_t(object.grip.holder)},
                           {"position", {p.x, p.y, p.z}},
                           {"scale", object.scale}});
        if (object.kind == session::ObjectKind::mark)
            if (const auto mark = session::decode_mark(object.properties))
                objects.back()["mark"] = exporting::mark_json(*mark);
        if (const auto screen = session::decode_shared_screen(object.kind, object.properties))
            objects.back()["screen"] = exporting::screen_json(*screen);
    }
    return {{"hash", session::hash_text(room.objects)},
            {"recorded_hash", session::hash_text(session::as_recorded(room.objects))},
            {"self", std::uint32_t(room.self)},
            {"people", people},
            {"objects", objects}};
}

}  // namespace theatron::app
