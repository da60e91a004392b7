// SPDX-License-Identifier: Apache-2.0
#include "session/replayed_room.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

ReplayedRoom::Step ReplayedRoom::show(const RoomObjects& recorded, TimePoint now) {
    const RoomObjects next = as_replayed(recorded);
    Step step;
    for (auto entry = objects_.begin(); entry != objects_.end();) {
        if (next.contains(entry->first)) {
            ++entry;
            continue;
        }
        step.changes.emplace_back(entry->first, std::nullopt);
        entry = objects_.erase(entry);
    }
    for (const auto& [id, object] : next) {
        const auto [known, is_new] = objects_.try_emplace(id, object);
        RoomObject& before = known->second;
        RoomObject after = object;
        after.moved_at = before.moved_at;
        if (!is_new && before == after)
            continue;
        const bool only_moves = !is_new && after.grip.holder != ParticipantId{} &&
                                after.grip == before.grip && after.kind == before.kind &&
                                after.creator == before.creator &&
                                after.properties == before.properties;
        // Receivers take only poses that are newer than the one before.
        after.moved_at = is_new ? now : std::max(now, before.moved_at + Duration(1));
        before = after;
        if (only_moves)
            step.moved.push_back(
                {id, after.grip, after.moved_at, after.room_from_object, after.scale});
        else
            step.changes.emplace_back(id, std::move(after));
    }
    return step;
}

}  // namespace theatron::session
