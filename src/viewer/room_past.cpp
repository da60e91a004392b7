// SPDX-License-Identifier: Apache-2.0
#include "viewer/room_past.h"

namespace theatron::viewer {

void RoomPast::note(const session::RoomObjects& objects, TimePoint now) {
    if (now < newest_)
        *this = RoomPast();
    newest_ = now;
    if (!first_)
        first_ = now;
    for (const auto& [id, object] : objects) {
        if (object.kind == session::ObjectKind::person)
            continue;
        std::deque<State>& states = states_[id];
        if (!states.empty() && states.back().object == object)
            continue;
        if (!states.empty() && states.back().object && now - states.back().from < step)
            states.back().object = object;
        else
            states.push_back({now, object});
    }
    for (auto& [id, states] : states_)
        if (states.back().object && objects.count(id) == 0)
            states.push_back({now, std::nullopt});
    forget(now);
}

void RoomPast::forget(TimePoint now) {
    for (auto one = states_.begin(); one != states_.end();) {
        std::deque<State>& states = one->second;
        while (states.size() > 1 && states[1].from <= now - reach)
            states.pop_front();
        const bool is_over = !states.front().object && states.size() == 1;
        one = is_over ? states_.erase(one) : std::next(one);
    }
}

session::RoomObjects RoomPast::at(TimePoint moment) const {
    session::RoomObjects objects;
    for (const auto& [id, states] : states_) {
        const State* then = nullptr;
        for (const State& state : states)
            if (state.from <= moment)
                then = &state;
        if (then && then->object)
            objects.emplace(id, *then->object);
    }
    return objects;
}

}  // namespace theatron::viewer
