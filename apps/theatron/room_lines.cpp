// SPDX-License-Identifier: Apache-2.0
#include "room_lines.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/log.h"
#include "base/steady_clock.h"
#include "room/bricks.h"
#include "viewer/meeting.h"

namespace theatron::app {
namespace {

namespace request = session::request;

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
    return look_at(place, at, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
}

const char* text_of(session::ObjectKind kind) {
    switch (kind) {
        case session::ObjectKind::person:
            return "person";
        case session::ObjectKind::brick:
            return "brick";
        case session::ObjectKind::organ:
            return "organ";
        case session::ObjectKind::screen:
            return "screen";
        case session::ObjectKind::mark:
            return "mark";
    }
    return "unknown";
}

}  // namespace

const char* RoomLines::help() {
    return "'stand X Y Z AT_X AT_Y AT_Z', 'point X Y Z AT_X AT_Y AT_Z', 'brick X Y Z',\n"
           "'grab NUMBER', 'move X Y Z [DEGREES]', 'release', 'give NAME', 'remove' (metres)";
}

void RoomLines::stand(const Pose& room_from_head) {
    pose_.head = viewer::part_of(room_from_head);
}

bool RoomLines::obey(const std::string& line, client::Participant& participant) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    for (const char* known :
         {"stand", "point", "brick", "grab", "move", "release", "give", "remove"})
        if (what == known) {
            if (!change(what, words, participant))
                log::say("'" + line + "' cannot be done. Lines are:\n" + help());
            return true;
        }
    return false;
}

bool RoomLines::change(const std::string& what, std::istream& words,
                       client::Participant& participant) {
    if (what == "stand" || what == "point") {
        Vec3 place, at;
        if (!read(words, place) || !read(words, at) || length(at - place) < 1e-6 ||
            length(cross(at - place, {0, 1, 0})) < 1e-6)
            return false;
        (what == "stand" ? pose_.head : pose_.right_hand) = viewer::part_of(towards(place, at));
        sent_ = {};
        return true;
    }
    if (what == "brick") {
        Vec3 place;
        return read(words, place) && participant.ask_room(request::Create{
                                         session::ObjectKind::brick,
                                         {{}, place},
                                         1,
                                         room::encode_brick({4, 2, next_color_++})}) != 0;
    }
    if (what == "grab") {
        std::uint32_t number = 0;
        words >> number;
        const auto room = participant.room();
        const auto found = room.objects.find(session::ObjectId(number));
        if (!words || found == room.objects.end())
            return false;
        const std::uint32_t grip = participant.ask_room(request::Grab{found->first});
        if (grip != 0)
            held_ = Held{found->first, grip, found->second.room_from_object};
        return grip != 0;
    }
    if (!held_)
        return false;
    if (what == "move") {
        Vec3 place;
        double degrees = 0;
        if (!read(words, place))
            return false;
        words >> degrees;
        held_->room_from_object = {rotation_about({0, 1, 0}, radians_of(degrees)), place};
        return participant.move_object(held_->object, held_->room_from_object, 1);
    }
    const Held held = *std::exchange(held_, std::nullopt);
    if (what == "release")
        return participant.ask_room(
                   request::Release{held.object, held.grip, held.room_from_object, 1}) != 0;
    if (what == "remove")
        return participant.ask_room(request::Remove{held.object}) != 0;
    std::string name;
    words >> name;
    for (const auto& person : viewer::people_of(participant.room(), {}, participant.now()))
        if (person.name == name)
            return participant.ask_room(request::HandOver{held.object, held.grip, person.id}) != 0;
    held_ = held;
    return false;
}

void RoomLines::on_tick(client::Participant& participant) {
    const bool stands = pose_.head || pose_.right_hand;
    const TimePoint now = steady_now();
    if (!stands || now - sent_ < pose_repeated_after || !participant.status().clock_known)
        return;
    sent_ = now;
    pose_.time = participant.now();
    participant.send_pose(pose_);
}

nlohmann::json room_json(const client::Participant& participant) {
    const auto room = participant.room();
    nlohmann::json people = nlohmann::json::array(), objects = nlohmann::json::array();
    for (const auto& [id, object] : room.objects) {
        if (object.kind == session::ObjectKind::person) {
            if (const auto facts = session::decode_person(object.properties))
                people.push_back({{"id", std::uint32_t(object.creator)},
                                  {"name", facts->name},
                                  {"records", facts->records}});
            continue;
        }
        const Vec3& p = object.room_from_object.translation;
        objects.push_back({{"id", std::uint32_t(id)},
                           {"kind", text_of(object.kind)},
                           {"held_by", std::uint32_t(object.grip.holder)},
                           {"position", {p.x, p.y, p.z}},
                           {"scale", object.scale}});
    }
    char hash[17];
    std::snprintf(hash, sizeof(hash), "%016llx",
                  static_cast<unsigned long long>(session::hash_of(room.objects)));
    return {{"hash", hash},
            {"self", std::uint32_t(room.self)},
            {"people", people},
            {"objects", objects}};
}

}  // namespace theatron::app
