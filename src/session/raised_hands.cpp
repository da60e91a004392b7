// SPDX-License-Identifier: Apache-2.0
#include "session/raised_hands.h"

#include <algorithm>

#include "session/room_bytes.h"

namespace theatron::session {

std::vector<RaisedHands::Hand> RaisedHands::take(const RoomObjects& objects) {
    std::vector<Hand> now;
    for (const auto& [id, object] : objects)
        if (object.kind == ObjectKind::person && !is_recorded(id))
            if (const auto facts = decode_person(object.properties); facts && facts->hand_raised)
                now.push_back({object.creator, facts->name});
    const auto has = [](const std::vector<Hand>& hands, ParticipantId person) {
        return std::any_of(hands.begin(), hands.end(),
                           [&](const Hand& hand) { return hand.person == person; });
    };
    std::erase_if(raised_, [&](const Hand& hand) { return !has(now, hand.person); });
    std::vector<Hand> news;
    for (const Hand& hand : now)
        if (!has(raised_, hand.person))
            news.push_back(hand);
    raised_.insert(raised_.end(), news.begin(), news.end());
    return news;
}

}  // namespace theatron::session
