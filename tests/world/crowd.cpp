// SPDX-License-Identifier: Apache-2.0
#include "world/crowd.h"

#include <algorithm>
#include <set>

#include "base/fault.h"
#include "wire/person_pose.h"
#include "wire/protocol.h"

namespace theatron::world {
namespace {

using Phase = client::Participant::Phase;
using session::ObjectId;
using session::ObjectKind;
namespace request = session::request;

// From a mended link or an act to its last consequence: the longest pause before another attempt,
// and the longest silence.
constexpr Duration patience = std::chrono::minutes(3);

Bytes mark_of(const Person& person, Vec3 place) {
    session::Mark mark;
    mark.kind = session::MarkKind::pin;
    mark.color = session::color_number(person.number());
    mark.initials = session::initials_of(person.name());
    mark.number = 1;
    mark.points = {{place, {0, 1, 0}}};
    return session::encode_mark(mark);
}

}  // namespace

Crowd::Crowd(unsigned seed) : world_(seed), random_(seed), faults_before_(fault_count()) {
    (void)world_.host();
    const std::pair<const char*, wire::Role> all[] = {
        {"Chief", wire::Role::operator_}, {"Anna", wire::Role::expert},
        {"Ben", wire::Role::expert},      {"Carl", wire::Role::publisher},
        {"Otto", wire::Role::observer},
    };
    for (const auto& [name, role] : all) {
        Person& person = world_.person(name);
        person.path().delay = Duration(1000 * (1 + number(200)));
        person.path().loss = number(3) == 0 ? 0.05 : 0;
        if (number(2) == 0)
            person.options.person = Bytes(wire::person_id_size, std::byte(1 + members_.size()));
        members_.push_back({&person, role, {}});
    }
}

std::string Crowd::live(Duration time, Duration quiet_every) {
    const TimePoint begun = world_.now();
    for (TimePoint quiet_at = begun + quiet_every; world_.now() < begun + time;
         quiet_at += quiet_every) {
        while (world_.now() < quiet_at)
            act();
        if (const std::string wrong = quiet(); !wrong.empty())
            return wrong;
    }
    return end();
}

void Crowd::act() {
    if (number(400) == 0) {
        world_.restart_host();
        for (Member& member : members_)
            if (member.person->is_here())
                member.person->join(member.role);
    }
    act(members_[std::size_t(number(int(members_.size())))]);
    world_.advance(Duration(1000 * number(4000)));
    mend_what_is_due(false);
}

void Crowd::act(Member& member) {
    Person& person = *member.person;
    if (!person.is_here()) {
        if (number(3) == 0)
            person.join(member.role);
        return;
    }
    if (!person.is_in()) {
        const Phase phase = person->status().phase;
        if (number(3) == 0 || phase == Phase::refused || phase == Phase::ended)
            person.leave();
        return;
    }
    switch (number(30)) {
        case 0:
            return person.leave();
        case 1:
            return person.path().reset();
        case 2:
            person.path().cut();
            member.mended_at = world_.now() + Duration(1000 * number(60000));
            return;
        case 3:
        case 4:
            return act_on_others(person);
        case 5: {
            const Bytes packet(std::size_t(1 + number(100)), std::byte(1));
            return person->send_voice(packet);
        }
        case 6:
        case 7: {
            wire::PersonPose pose;
            pose.time = person->now();
            pose.head = wire::PartPose{{float(number(3)), 1.6f, 0}};
            return person->send_pose(pose);
        }
        case 8:
            (void)person->write_chat("message " + std::to_string(++messages_));
            return;
        case 9:
            (void)person->raise_hand(number(2) == 0);
            return;
        default:
            return act_in_room(person);
    }
}

void Crowd::act_in_room(Person& person) {
    const auto objects = person.room().objects;
    std::vector<ObjectId> all, held;
    for (const auto& [id, object] : objects) {
        if (object.kind != ObjectKind::person)
            all.push_back(id);
        if (object.grip.holder == person.number())
            held.push_back(id);
    }
    if (!held.empty() && number(2) == 0) {
        const ObjectId object = held[std::size_t(number(int(held.size())))];
        const session::RoomObject& now = objects.at(object);
        const Pose there{{}, place()};
        switch (number(4)) {
            case 0:
                (void)person->ask_room(request::Release{object, now.grip.number, there, 1});
                return;
            case 1: {
                const Person& other = *members_[std::size_t(number(int(members_.size())))].person;
                const ParticipantId to = person.number_of(other.name());
                (void)person->ask_room(request::HandOver{object, now.grip.number, to});
                return;
            }
            default:
                for (int i = 0; i < 5; ++i)
                    (void)person->move_object(object, {{}, place()}, 1);
                return;
        }
    }
    const ObjectId any =
        all.empty() ? ObjectId(unsigned(number(100))) : all[std::size_t(number(int(all.size())))];
    switch (number(10)) {
        case 0:
        case 1:
            (void)person->ask_room(
                request::Create{ObjectKind::brick, {{}, place()}, 1, Bytes(4, std::byte(1))});
            return;
        case 2:
        case 3:
            (void)person->ask_room(
                request::Create{ObjectKind::mark, {}, 1, mark_of(person, place())});
            return;
        case 4:
            (void)person->ask_room(request::Remove{any});
            return;
        case 5:
            (void)person->ask_room(request::ClearMarks{number(4) == 0});
            return;
        case 6:
            (void)person->ask_room(request::SetProperties{any, Bytes(3, std::byte(number(200)))});
            return;
        default:
            (void)person->ask_room(request::Grab{any});
    }
}

void Crowd::act_on_others(Person& person) {
    using wire::ManageAction;
    const Person& other = *members_[std::size_t(number(int(members_.size())))].person;
    const ParticipantId whom = person.number_of(other.name());
    const ManageAction actions[] = {ManageAction::mute, ManageAction::unmute,
                                    ManageAction::set_role};
    const ManageAction action = number(40) == 0 ? ManageAction::remove : actions[number(3)];
    (void)person->manage(action, whom, wire::roles[number(4)]);
}

void Crowd::mend_what_is_due(bool all) {
    for (Member& member : members_)
        if (all || member.mended_at <= world_.now())
            member.person->path().mend();
}

std::string Crowd::quiet() {
    mend_what_is_due(true);
    const auto is_settled = [](const Person& person) {
        if (!person.is_here())
            return true;
        const auto status = person.participant().status();
        return person.is_in() || status.phase == Phase::refused || status.phase == Phase::ended ||
               status.phase == Phase::waiting;
    };
    for (const Member& member : members_)
        if (!world_.until([&] { return is_settled(*member.person); }, patience))
            return member.person->name() + " is not in again";
    // Their requests are decided, and those who are gone were noticed.
    world_.advance(40s);
    if (!std::all_of(members_.begin(), members_.end(),
                     [&](const Member& member) { return is_settled(*member.person); }))
        return "somebody is out again although all links are well";
    return agreement();
}

// Empty: each message that the person knows is there once, and none of theirs waits.
std::string Crowd::chat_fault(const Person& person) {
    const client::Participant::Chat chat = person.participant().chat();
    if (!chat.unsent.empty())
        return person.name() + " has written '" + chat.unsent.front() + "', which the host lacks";
    std::set<std::string> texts;
    for (const wire::ChatMessage& message : chat.messages)
        if (!texts.insert(message.text).second)
            return person.name() + " reads '" + message.text + "' twice";
    return "";
}

std::string Crowd::agreement() {
    // The room as the host tells it to somebody who comes now.
    Person& witness = world_.person("Witness");
    witness.join(wire::Role::observer);
    if (!world_.until([&] { return witness.is_in(); }, patience))
        return "a newcomer does not come in";
    world_.advance(5s);
    if (const std::string differs = difference(world_); !differs.empty())
        return differs;
    std::size_t in = 1;
    std::vector<std::string> names{"Witness"};
    std::map<ParticipantId, std::string> there{{witness.number(), "Witness"}};
    for (const Member& member : members_) {
        const Person& person = *member.person;
        const bool waits =
            person.is_here() && person.participant().status().phase == Phase::waiting;
        if (person.path().connections() != std::size_t(person.is_in() || waits))
            return person.name() + " has " + std::to_string(person.path().connections()) +
                   " connections";
        if (!person.is_in())
            continue;
        ++in;
        names.push_back(person.name());
        if (std::string fault = chat_fault(person); !fault.empty())
            return fault;
        there[person.number()] = person.name();
    }
    for (const Member& member : members_)
        if (member.person->is_in())
            for (const auto& [id, pose] : member.person->participant().poses())
                if (!there.contains(id))
                    return member.person->name() + " sees a pose of nobody who is there";
    std::sort(names.begin(), names.end());
    if (witness.sees() != names)
        return "the room shows other people than those who are there";
    for (const auto& [id, object] : witness.room().objects) {
        seen_.objects += object.kind != ObjectKind::person;
        seen_.held += object.grip.holder != ParticipantId{};
        if (object.grip.holder != ParticipantId{} && !there.contains(object.grip.holder))
            return "object " + std::to_string(std::uint32_t(id)) +
                   " is held by nobody who is there";
    }
    seen_.people += in;
    for (const auto& [id, pose] : witness->poses())
        if (!there.contains(id))
            return "a pose is of nobody who is there";
    if (world_.host().participants() != in)
        return "the host counts " + std::to_string(world_.host().participants()) + " people, not " +
               std::to_string(in);
    if (fault_count() != faults_before_)
        return std::to_string(fault_count() - faults_before_) + " faults";
    witness.leave();
    return "";
}

std::string Crowd::end() {
    for (Member& member : members_)
        member.person->leave();
    if (!world_.until([&] { return world_.host().participants() == 0; }, patience))
        return "people who have left are still there";
    world_.end_host();
    world_.advance(patience);
    if (world_.events() != 0)
        return std::to_string(world_.events()) + " events are left of a world without anybody";
    return "";
}

}  // namespace theatron::world
