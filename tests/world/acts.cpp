// SPDX-License-Identifier: Apache-2.0
#include "world/acts.h"

#include <algorithm>

namespace theatron::world {
namespace {

using session::ObjectId;
using session::ObjectKind;
using session::Refusal;

// The own object of this kind with the highest number.
ObjectId newest(const Person& person, ObjectKind kind) {
    ObjectId found{};
    for (const auto& [id, object] : person.objects(kind))
        if (object.creator == person.number())
            found = std::max(found, id);
    return found;
}

ObjectId make(World& world, Person& person, ObjectKind kind, Vec3 place, Bytes properties) {
    const ObjectId before = newest(person, kind);
    if (ask(world, person, session::request::Create{kind, {{}, place}, 1, std::move(properties)}) !=
        Refusal::none)
        return {};
    (void)world.until([&] { return newest(person, kind) != before; });
    return newest(person, kind);
}

}  // namespace

Refusal ask(World& world, Person& person, const session::Request& request) {
    const std::uint32_t number = person->ask_room(request);
    // The host answers in the order of its messages: a ping behind the request is behind its
    // answer.
    const int pongs = person->status().pongs;
    std::optional<std::pair<std::uint32_t, Refusal>> refused;
    (void)world.until([&] {
        if (!refused)
            refused = person->take_room_refusal();
        return refused || person->status().pongs > pongs + 1;
    });
    return refused && refused->first == number ? refused->second : Refusal::none;
}

ObjectId make_brick(World& world, Person& person, Vec3 place) {
    return make(world, person, ObjectKind::brick, place, Bytes(4, std::byte(1)));
}

ObjectId make_mark(World& world, Person& person, Vec3 place) {
    session::Mark mark;
    mark.kind = session::MarkKind::pin;
    mark.color = session::color_number(person.number());
    mark.initials = session::initials_of(person.name());
    mark.number = 1;
    mark.points = {{place, {0, 1, 0}}};
    return make(world, person, ObjectKind::mark, {}, session::encode_mark(mark));
}

Refusal grab(World& world, Person& person, ObjectId object) {
    return ask(world, person, session::request::Grab{object});
}

Refusal release(World& world, Person& person, ObjectId object) {
    const session::RoomObject held = person.room().objects[object];
    return ask(
        world, person,
        session::request::Release{object, held.grip.number, held.room_from_object, held.scale});
}

Refusal give(World& world, Person& person, ObjectId object, const Person& to) {
    const session::RoomObject held = person.room().objects[object];
    return ask(world, person, session::request::HandOver{object, held.grip.number, to.number()});
}

ParticipantId holder(const Person& person, ObjectId object) {
    const session::RoomObjects objects = person.room().objects;
    const auto found = objects.find(object);
    return found == objects.end() ? ParticipantId{} : found->second.grip.holder;
}

std::string difference(const World& world) {
    const Person* first = nullptr;
    for (const auto& person : world.people()) {
        if (!person->is_in())
            continue;
        if (!first) {
            first = person.get();
            continue;
        }
        const auto a = first->room().objects, b = person->room().objects;
        const std::string pair = first->name() + " and " + person->name();
        for (const auto* objects : {&a, &b})
            for (const auto& [id, object] : *objects) {
                const bool both = a.contains(id) && b.contains(id);
                if (!both || a.at(id) != b.at(id))
                    return pair + " see another object " + std::to_string(std::uint32_t(id));
            }
    }
    return "";
}

bool all_agree(const World& world) {
    return difference(world).empty();
}

}  // namespace theatron::world
