// SPDX-License-Identifier: Apache-2.0
// Going to people, and calls of people to each other.
#include <utility>

#include "phrases/phrase.h"
#include "session/permissions.h"
#include "viewer/viewer.h"

namespace theatron::viewer {

void Viewer::set_voices(Voices voices) {
    scene_changed_ = scene_.meeting().set_speaking(voices.speaking) || scene_changed_;
    voices_ = std::move(voices);
}

// Where one stands beside a person; nothing if the person has no place.
std::optional<Pose> Viewer::place_beside(ParticipantId id) const {
    const room::RoomPerson* person = scene_.meeting().person(id);
    if (!person)
        return std::nullopt;
    std::vector<Vec3> heads;
    for (const room::RoomPerson& other : scene_.meeting().people())
        if (other.id != id && other.head)
            heads.push_back(other.head->translation);
    return beside(*person->head, heads);
}

// The person then stands at this eye, except in a real room, which does not move.
void Viewer::bring(const Pose& room_from_eye) {
    if (headset_) {
        if (!scene_.has_real_room())
            headset_->go_to(room_from_eye);
        return;
    }
    stop_following();
    scene_changed_ = true;
    eye_.go_to(room_from_eye);
}

void Viewer::go_to_person(ParticipantId id, TimePoint now) {
    const auto place = place_beside(id);
    if (!place || !eye_.is_placed())
        return note(say(Phrase::person_has_left), now);
    bring(*place);
    note(say(Phrase::beside, scene_.meeting().name_of(id)), now);
}

void Viewer::call(bool begins, TimePoint now) {
    if (begins && !session::may(participant_.status().standing.role, session::Right::point))
        return note(say(Phrase::may_not_call), now);
    calls_until_ = begins ? now + Meeting::called_for : TimePoint{};
    note(say(begins ? Phrase::you_call : Phrase::you_call_no_more), now);
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

void Viewer::look_through_followed(TimePoint now) {
    if (!followed_ || !eye_.is_placed())
        return;
    const room::RoomPerson* person = scene_.meeting().person(*followed_);
    if (!person) {
        stop_following();
        return note(say(Phrase::followed_has_left), now);
    }
    // The eye's frame has y down and z forward.
    eye_.go_to(*person->head * Pose{Quat{0, 1, 0, 0}, {}});
}

}  // namespace theatron::viewer
