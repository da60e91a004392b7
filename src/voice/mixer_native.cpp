// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "voice/mixer.h"

namespace theatron::voice {

void Mixer::put(ParticipantId speaker, ByteView bytes, TimePoint now) {
    const auto packet = parse_packet(bytes);
    if (!packet) {
        ++unreadable_;
        return;
    }
    auto found = voices_.find(speaker);
    if (found == voices_.end()) {
        if (voices_.size() >= max_speakers)
            voices_.erase(std::min_element(
                voices_.begin(), voices_.end(),
                [](const auto& a, const auto& b) { return a.second->newest < b.second->newest; }));
        found = voices_.emplace(speaker, std::make_unique<Voice>()).first;
    }
    found->second->newest = now;
    found->second->playout.put(*packet, now);
}

void Mixer::pull(std::span<float> out, TimePoint now) {
    std::fill(out.begin(), out.end(), 0.0f);
    for (const Heard& heard : pull_each(out.size(), now))
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += heard.samples[i];
    for (float& v : out)
        v = std::clamp(v, -1.0f, 1.0f);
}

std::vector<Mixer::Heard> Mixer::pull_each(std::size_t count, TimePoint now) {
    std::vector<Heard> all;
    for (const auto& [id, voice] : voices_) {
        voice->samples.resize(count);
        voice->playout.pull(voice->samples, now);
        all.push_back({id, voice->samples});
    }
    return all;
}

std::vector<Mixer::Speaker> Mixer::speakers() const {
    std::vector<Speaker> result;
    for (const auto& [id, voice] : voices_)
        result.push_back(
            {id, voice->playout.level_db(), voice->playout.delay(), voice->playout.figures()});
    return result;
}

}  // namespace theatron::voice
