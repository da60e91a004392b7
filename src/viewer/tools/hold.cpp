// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/hold.h"

#include <algorithm>
#include <cmath>

#include "phrases/phrase.h"
#include "room/bricks.h"
#include "session/shared_screen.h"
#include "viewer/refusal_text.h"

namespace theatron::viewer {
namespace {

namespace request = session::request;

const session::RoomObject* find(const HoldRoom& room, session::ObjectId object) {
    const auto found = room.objects.find(object);
    return found == room.objects.end() ? nullptr : &found->second;
}

const session::CaseInRoom::Part* part_of(const HoldRoom& room, session::ObjectId object) {
    return room.open ? room.open->find(object) : nullptr;
}

std::string name_of(const HoldRoom& room, ParticipantId id) {
    for (const room::RoomPerson& person : room.people)
        if (person.id == id)
            return person.name;
    return "";
}

struct Near {
    ParticipantId person{};
    double distance_m = 0;
};
// The other person whose head or hand is nearest to a place of the room.
std::optional<Near> nearest(const HoldRoom& room, Vec3 place) {
    std::optional<Near> nearest;
    for (const room::RoomPerson& person : room.people)
        for (const auto& part : {person.head, person.left_hand, person.right_hand})
            if (part)
                if (const double distance = length(part->translation - place);
                    !nearest || distance < nearest->distance_m)
                    nearest = Near{person.id, distance};
    return nearest;
}

}  // namespace

Pose shown_pose(const HoldRoom& room, session::ObjectId object) {
    if (room.drawn)
        if (const auto shown = room.drawn->shown_pose(object))
            return *shown;
    if (const auto* part = part_of(room, object))
        return session::part_in_room(room.open->organ_object, part->object.room_from_object).pose;
    const session::RoomObject* found = find(room, object);
    return found ? found->room_from_object : Pose{};
}

Pose stored_pose(const HoldRoom& room, session::ObjectId object, const Pose& room_from_shown) {
    if (room.drawn)
        return room.drawn->stored_pose(object, room_from_shown).value_or(room_from_shown);
    return part_of(room, object) ? session::part_in_organ(room.open->organ_object, room_from_shown)
                                 : room_from_shown;
}

Pose resting(const HoldRoom& room, session::ObjectId object, const Pose& released) {
    const session::RoomObject* moved = find(room, object);
    const auto brick = moved && moved->kind == session::ObjectKind::brick
                           ? room::decode_brick(moved->properties)
                           : std::nullopt;
    if (!brick)
        return released;
    std::vector<room::PlacedBrick> others;
    for (const auto& [id, other] : room.objects)
        if (id != object && other.kind == session::ObjectKind::brick)
            if (const auto placed = room::decode_brick(other.properties))
                others.push_back({*placed, other.room_from_object});
    return room::snapped(*brick, released, others);
}

void ask(const HoldStep& step, client::Participant& participant) {
    for (const session::Request& asked : step.requests)
        (void)participant.ask_room(asked);
}

session::ObjectId Hold::taken(const HoldRoom& room, session::ObjectId object, bool part) {
    return !part && part_of(room, object) ? room.open->organ_id : object;
}

HoldStep Hold::take(const HoldRoom& room, session::ObjectId object, bool part,
                    const std::optional<Grip>& grip, Vec3 place) {
    object = taken(room, object, part);
    const session::RoomObject* found = find(room, object);
    if (!found)
        return {};
    const ParticipantId holder = found->grip.holder;
    if (holder != ParticipantId{} && holder != room.self)
        return {{}, say(Phrase::holds_this, name_of(room, holder))};
    if (session::is_pinned(*found))
        return {{}, text_of(session::Refusal::pinned)};
    const Pose shown = shown_pose(room, object);
    held_ = Held{object, std::nullopt, shown, found->scale};
    if (grip)
        held_->grasp.emplace(shown, *grip, place);
    stretch_.reset();
    return {{request::Grab{object}}, ""};
}

bool Hold::follow(const HoldRoom& room) {
    if (!held_)
        return false;
    const session::RoomObject* found = find(room, held_->object);
    if (!found || found->grip.holder != room.self)
        held_.reset();
    return holds();
}

bool Hold::adopt(const HoldRoom& room) {
    if (follow(room))
        return true;
    for (const auto& [id, object] : room.objects)
        if (object.kind != session::ObjectKind::person && object.grip.holder == room.self) {
            held_ = Held{id, std::nullopt, shown_pose(room, id), object.scale};
            return true;
        }
    return false;
}

void Hold::put(const Pose& room_from_object) {
    held_->grasp.reset();
    held_->room_from_object = room_from_object;
}

Pose Hold::pose() const {
    return held_->grasp ? held_->grasp->room_from_object() : held_->room_from_object;
}

std::uint32_t Hold::grip_number(const HoldRoom& room) const {
    const session::RoomObject* found = find(room, held_->object);
    return found ? found->grip.number : 0;
}

bool Hold::set_scale(const HoldRoom& room, double scale) {
    const session::RoomObject* found = held_ ? find(room, held_->object) : nullptr;
    const bool is_organ = room.open && held_ && held_->object == room.open->organ_id;
    if (!found || (!is_organ && !session::is_shared_screen(*found)))
        return false;
    if (is_organ ? !(scale >= least_scale && scale <= largest_scale)
                 : !session::is_screen_width(scale))
        return false;
    held_->scale = scale;
    return true;
}

bool Hold::begin_stretch(const HoldRoom& room, double distance_m) {
    constexpr double least_m = 0.02;
    if (!held_ || !set_scale(room, held_->scale))
        return false;
    stretch_ = Stretch{std::max(distance_m, least_m), held_->scale};
    return true;
}

void Hold::stretch(const HoldRoom& room, double distance_m) {
    if (stretch_ && held_)
        (void)set_scale(room, stretch_->scale * distance_m / stretch_->distance_m);
}

std::optional<HoldMove> Hold::move(const HoldRoom& room) const {
    if (!held_)
        return std::nullopt;
    return HoldMove{held_->object, stored_pose(room, held_->object, pose()), held_->scale};
}

HoldStep Hold::let_go(const HoldRoom& room) {
    const Pose rests = stored_pose(room, held_->object, resting(room, held_->object, pose()));
    const request::Release release{held_->object, grip_number(room), rests, held_->scale};
    held_.reset();
    return {{release}, ""};
}

HoldStep Hold::let_go_by_hand(const HoldRoom& room) {
    const auto near = nearest(room, pose().translation);
    return near && near->distance_m < gives_within_m ? give(room, near->person) : let_go(room);
}

HoldStep Hold::give(const HoldRoom& room, ParticipantId to) {
    const request::HandOver given{held_->object, grip_number(room), to};
    held_.reset();
    return {{given}, say(Phrase::given_to, name_of(room, to))};
}

HoldStep Hold::give_to_nearest(const HoldRoom& room) {
    const auto near = nearest(room, pose().translation);
    return near ? give(room, near->person) : HoldStep{{}, say(Phrase::nobody_near)};
}

HoldStep Hold::remove(const HoldRoom& room) {
    if (const auto* part = part_of(room, held_->object)) {
        session::CasePart hidden = part->facts;
        hidden.shown = false;
        const request::SetProperties hide{part->id, session::encode_case_object(hidden)};
        HoldStep step = let_go(room);
        step.requests.push_back(hide);
        return step;
    }
    if (const session::RoomObject* found = find(room, held_->object);
        found && session::is_shared_screen(*found))
        return {{}, say(Phrase::use_screens_panel)};
    if (room.open && (held_->object == room.open->organ_id ||
                      (room.open->screen && held_->object == room.open->screen->id)))
        return {{}, say(Phrase::use_case_panel)};
    const request::Remove removed{held_->object};
    held_.reset();
    return {{removed}, ""};
}

}  // namespace theatron::viewer
