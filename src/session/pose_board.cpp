// SPDX-License-Identifier: Apache-2.0
#include "session/pose_board.h"

#include <algorithm>
#include <utility>

#include "session/state_rights.h"
#include "wire/face_expression.h"
#include "wire/person_pose.h"

namespace theatron::session {
namespace {

using wire::StateKey, wire::StateTopic;

// Unknown topics count as poses.
StateKey key_of(ParticipantId participant, StateTopic topic) {
    return {topic == StateTopic::expression ? topic : StateTopic::pose, std::uint32_t(participant)};
}

// The time that a state is for; no value if it is damaged.
Result<TimePoint> time_of(const wire::State& state) {
    if (state.key.topic == StateTopic::expression) {
        const auto expression = wire::decode_face_expression(state.body);
        return expression ? Result(expression->time) : expression.error();
    }
    const auto pose = wire::decode_person_pose(state.body);
    return pose ? Result(pose->time) : pose.error();
}

// The state by which the others know that nothing is there any more.
Bytes nothing_of(StateTopic topic, TimePoint time) {
    if (topic == StateTopic::expression)
        return without_right({{topic, 0}, {}}, time);
    wire::PersonPose nothing;
    nothing.time = time;
    return wire::encode_person_pose(nothing);
}

}  // namespace

void PoseBoard::note_new(Kept& kept, TimePoint now) {
    kept.is_new = true;
    if (!new_since_)
        new_since_ = now;
}

PoseBoard::Answer PoseBoard::put(ParticipantId sender, const wire::State& state, const May& may,
                                 TimePoint now) {
    const StateKey key = key_of(sender, state.key.topic);
    Kept& kept =
        states_.try_emplace(key, key.topic == StateTopic::expression ? expression_limit : limit)
            .first->second;
    if (!kept.budget.take(now))
        return Answer::flood;
    const bool own = state.key == key && !kept.has_left;
    const auto time = own ? time_of(state) : Status::malformed;
    if (!time || *time > now + max_pose_lead || (!kept.body.empty() && *time <= kept.time))
        return Answer::ignored;
    const auto right = needed_right(state);
    const bool is_whole = !right || may(*right);
    if (!is_whole && key.topic == StateTopic::expression)
        return Answer::ignored;
    kept.time = *time;
    if (is_whole)
        kept.body.assign(state.body.begin(), state.body.end());
    else
        kept.body = without_right(state, *time);
    note_new(kept, now);
    return Answer::kept;
}

void PoseBoard::follow_rights(ParticipantId participant, const May& may, TimePoint now) {
    for (auto& [key, kept] : states_) {
        if (key.id != std::uint32_t(participant) || kept.body.empty() || kept.has_left)
            continue;
        const wire::State state{key, kept.body};
        const auto right = needed_right(state);
        if (!right || may(*right))
            continue;
        // Behind the newest of the sender, or the others would take it for an older one.
        kept.time = std::max(now, kept.time + Duration(1));
        kept.body = without_right(state, kept.time);
        note_new(kept, now);
    }
}

void PoseBoard::remove(ParticipantId participant, TimePoint now) {
    for (const StateTopic topic : {StateTopic::pose, StateTopic::expression})
        remove(key_of(participant, topic), now);
}

void PoseBoard::remove(StateKey key, TimePoint now) {
    const auto found = states_.find(key);
    if (found == states_.end())
        return;
    Kept& kept = found->second;
    if (kept.body.empty()) {
        states_.erase(found);
        return;
    }
    kept.has_left = true;
    kept.body = nothing_of(key.topic, std::max(now, kept.time + Duration(1)));
    note_new(kept, now);
}

std::optional<TimePoint> PoseBoard::due() const {
    if (!new_since_)
        return std::nullopt;
    return std::max(*new_since_, gathered_ + period);
}

std::vector<PoseBoard::Entry> PoseBoard::gather(TimePoint now) {
    std::vector<Entry> entries;
    left_.clear();
    left_.reserve(states_.size());  // the views stay valid
    for (auto state = states_.begin(); state != states_.end();) {
        auto& [key, kept] = *state;
        const ParticipantId participant{key.id};
        if (!std::exchange(kept.is_new, false)) {
            ++state;
        } else if (kept.has_left) {
            entries.push_back({participant, {key, left_.emplace_back(std::move(kept.body))}});
            state = states_.erase(state);
        } else {
            entries.push_back({participant, {key, kept.body}});
            ++state;
        }
    }
    new_since_.reset();
    gathered_ = now;
    return entries;
}

std::vector<PoseBoard::Entry> PoseBoard::all() const {
    std::vector<Entry> entries;
    for (const auto& [key, kept] : states_)
        if (!kept.body.empty() && !kept.has_left)
            entries.push_back({ParticipantId{key.id}, {key, kept.body}});
    return entries;
}

}  // namespace theatron::session
