// SPDX-License-Identifier: Apache-2.0
// Acts of people in the room of a World, each until the host has answered.
#pragma once

#include <string>

#include "session/mark.h"
#include "world/world.h"

namespace theatron::world {

// The newest brick of this person; ObjectId{} where the host refused it.
session::ObjectId make_brick(World& world, Person& person, Vec3 place = {0, 1, 0});
// The same of a pin.
session::ObjectId make_mark(World& world, Person& person, Vec3 place = {0, 1, 0});

// None: the host has done it.
session::Refusal ask(World& world, Person& person, const session::Request& request);
session::Refusal grab(World& world, Person& person, session::ObjectId object);
// The person holds it; its place stays.
session::Refusal release(World& world, Person& person, session::ObjectId object);
session::Refusal give(World& world, Person& person, session::ObjectId object, const Person& to);

// As this person sees it: {} if nobody holds it, or there is none.
ParticipantId holder(const Person& person, session::ObjectId object);

// True if all people of the World who are in see the same room.
bool all_agree(const World& world);
// A difference between what they see, in words; empty: there is none.
std::string difference(const World& world);

}  // namespace theatron::world
