// SPDX-License-Identifier: Apache-2.0
#include "session/pose_board.h"

#include <algorithm>
#include <utility>

namespace theatron::session {
namespace {

wire::State state_of(ParticipantId participant, const Bytes& body) {
    return {{wire::StateTopic::pose, std::uint32_t(participant)}, body};
}

}  // namespace

void PoseBoard::note_new(Person& person, TimePoint now) {
    person.is_new = true;
    if (!new_since_)
        new_since_ = now;
}

PoseBoard::Answer PoseBoard::put(ParticipantId sender, const wire::State& state, TimePoint now) {
    Person& person = people_[sender];
    if (!person.budget.take(now))
        return Answer::flood;
    const bool own = state.key.topic == wire::StateTopic::pose &&
                     state.key.id == std::uint32_t(sender) && !person.has_left;
    const auto pose = own ? wire::decode_person_pose(state.body) : Status::malformed;
    if (!pose || pose->time > now + max_pose_lead ||
        (!person.body.empty() && pose->time <= person.time))
        return Answer::ignored;
    person.time = pose->time;
    person.body.assign(state.body.begin(), state.body.end());
    note_new(person, now);
    return Answer::kept;
}

void PoseBoard::remove(ParticipantId participant, TimePoint now) {
    const auto found = people_.find(participant);
    if (found == people_.end())
        return;
    Person& person = found->second;
    if (person.body.empty()) {
        people_.erase(found);
        return;
    }
    person.has_left = true;
    wire::PersonPose nothing;
    nothing.time = std::max(now, person.time + Duration(1));
    person.body = wire::encode_person_pose(nothing);
    note_new(person, now);
}

std::optional<TimePoint> PoseBoard::due() const {
    if (!new_since_)
        return std::nullopt;
    return std::max(*new_since_, gathered_ + period);
}

std::vector<PoseBoard::Entry> PoseBoard::gather(TimePoint now) {
    std::vector<Entry> entries;
    left_.clear();
    left_.reserve(people_.size());  // the views stay valid
    for (auto person = people_.begin(); person != people_.end();) {
        auto& [id, p] = *person;
        if (!std::exchange(p.is_new, false)) {
            ++person;
        } else if (p.has_left) {
            entries.push_back({id, state_of(id, left_.emplace_back(std::move(p.body)))});
            person = people_.erase(person);
        } else {
            entries.push_back({id, state_of(id, p.body)});
            ++person;
        }
    }
    new_since_.reset();
    gathered_ = now;
    return entries;
}

std::vector<PoseBoard::Entry> PoseBoard::all() const {
    std::vector<Entry> entries;
    for (const auto& [id, person] : people_)
        if (!person.body.empty() && !person.has_left)
            entries.push_back({id, state_of(id, person.body)});
    return entries;
}

}  // namespace theatron::session
