// SPDX-License-Identifier: Apache-2.0
#include "voice/speakers.h"

#include <algorithm>

#include "voice/packet.h"

namespace theatron::voice {

void Speakers::hear(ParticipantId speaker, ByteView packet, TimePoint now) {
    const auto parsed = parse_packet(packet);
    if (!parsed)
        return;
    if (parsed->level_db < speech_db) {
        if (const auto known = speech_.find(speaker); known != speech_.end())
            known->second.level_db = parsed->level_db;
        return;
    }
    const auto [known, is_new] = speech_.try_emplace(speaker, Speech{now, now, 0});
    if (!is_new && now - known->second.newest > pause)
        known->second.begin = now;
    known->second.newest = now;
    known->second.level_db = parsed->level_db;
    if (speech_.size() > most_speakers)
        speech_.erase(std::min_element(speech_.begin(), speech_.end(), [](auto& a, auto& b) {
            return a.second.newest < b.second.newest;
        }));
}

std::set<ParticipantId> Speakers::speaking(TimePoint now) const {
    std::set<ParticipantId> result;
    for (const auto& [id, speech] : speech_)
        if (now - speech.newest <= pause && speech.newest - speech.begin >= begins_after)
            result.insert(id);
    return result;
}

std::map<ParticipantId, int> Speakers::levels_db(TimePoint now) const {
    std::map<ParticipantId, int> result;
    for (const ParticipantId id : speaking(now))
        result[id] = speech_.at(id).level_db;
    return result;
}

}  // namespace theatron::voice
