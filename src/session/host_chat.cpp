// SPDX-License-Identifier: Apache-2.0
#include "session/host_chat.h"

#include <algorithm>
#include <utility>

#include "base/shown_name.h"
#include "base/trimmed.h"

namespace theatron::session {

void HostChat::send(ParticipantId participant, std::vector<wire::ChatMessage> messages) {
    actions_.push_back(action::Send{participant, wire::ChatMessages{std::move(messages)}});
}

void HostChat::join(ParticipantId id) {
    const Admission::Participant& participant = *admission_.find(id);
    if (!participant.has(wire::Feature::chat) || participant.run == 0)
        return;
    if (runs_.size() >= max_runs && !runs_.contains(participant.run))
        runs_.erase(std::min_element(runs_.begin(), runs_.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
        }));
    const std::uint64_t first = runs_.try_emplace(participant.run, count_).first->second;
    std::vector<wire::ChatMessage> missed;
    for (const Kept& kept : kept_) {
        if (kept.number < first)
            continue;
        missed.push_back(kept.message);
        if (missed.size() == wire::max_chat_messages)
            send(id, std::exchange(missed, {}));
    }
    if (!missed.empty())
        send(id, std::move(missed));
}

void HostChat::write(ParticipantId author, const wire::WriteChat& written, TimePoint now) {
    const Admission::Participant& by = *admission_.find(author);
    if (!by.has(wire::Feature::chat))
        return;
    const auto same = std::find_if(kept_.begin(), kept_.end(),
                                   [&](const Kept& kept) { return kept.message.id == written.id; });
    if (same != kept_.end())
        return send(author, {same->message});
    std::string text(trimmed(written.text));
    if (clean_name(text, text.size()).empty())
        return;
    if (kept_.size() >= max_kept)
        kept_.pop_front();
    kept_.push_back({count_++, {written.id, author, by.name, std::move(text), now}});
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part() && participant.has(wire::Feature::chat))
            send(id, {kept_.back().message});
}

void HostChat::clear() {
    kept_.clear();
    runs_.clear();
}

}  // namespace theatron::session
