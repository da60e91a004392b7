// SPDX-License-Identifier: Apache-2.0
#include "session/raised_hands.h"

#include <algorithm>

#include "session/room_bytes.h"

namespace theatron::session {
namespace {

bool is_among(const std::vector<RaisedHands::Hand>& hands, ParticipantId person) {
    return std::any_of(hands.begin(), hands.end(),
                       [&](const auto& hand) { return hand.person == person; });
}

}  // namespace

bool RaisedHands::has(ParticipantId person) const {
    return is_among(raised_, person);
}

std::vector<RaisedHands::Hand> RaisedHands::take(const RoomObjects& objects) {
    std::vector<Hand> now;
    for (const auto& [id, object] : objects)
        if (object.kind == ObjectKind::person && !is_recorded(id))
            if (const auto facts = decode_person(object.properties); facts && facts->hand_raised)
                now.push_back({object.creator, facts->name});
    std::erase_if(raised_, [&](const Hand& hand) { return !is_among(now, hand.person); });
    std::vector<Hand> news;
    for (const Hand& hand : now)
        if (!has(hand.person))
            news.push_back(hand);
    raised_.insert(raised_.end(), news.begin(), news.end());
    return news;
}

}  // namespace theatron::session
