// SPDX-License-Identifier: Apache-2.0
// Going to people, and calls of people to each other.
#include "session/permissions.h"
#include "viewer/viewer.h"

namespace theatron::viewer {

void Viewer::go_to_person(ParticipantId id, TimePoint now) {
    const room::RoomPerson* person = scene_.meeting().person(id);
    if (!person || !eye_.is_placed())
        return note("This person has left", now);
    stop_following();
    scene_changed_ = true;
    std::vector<Vec3> heads;
    for (const room::RoomPerson& other : scene_.meeting().people())
        if (other.id != id && other.head)
            heads.push_back(other.head->translation);
    eye_.go_to(beside(*person->head, heads));
    note("Beside " + person->name, now);
}

void Viewer::call(bool begins, TimePoint now) {
    if (begins && !session::may(participant_.status().standing.role, session::Right::point))
        return note("Your role does not allow to call others.", now);
    calls_until_ = begins ? now + Meeting::called_for : TimePoint{};
    note(begins ? "You ask the others to come to you; they decide." : "You no longer call.", now);
}

void Viewer::answer_call(ParticipantId person, bool comes, TimePoint now) {
    answered_.insert(person);
    if (comes)
        go_to_person(person, now);
}

std::vector<room::RoomPerson> Viewer::callers() const {
    std::vector<room::RoomPerson> callers;
    for (const room::RoomPerson& person : scene_.meeting().people())
        if (person.calls && person.head && !answered_.contains(person.id))
            callers.push_back(person);
    return callers;
}

// The next call of the same person is offered again.
void Viewer::forget_answered() {
    std::erase_if(answered_, [&](ParticipantId id) {
        const room::RoomPerson* person = scene_.meeting().person(id);
        return !person || !person->calls;
    });
}

}  // namespace theatron::viewer
