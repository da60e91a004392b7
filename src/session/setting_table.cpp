// SPDX-License-Identifier: Apache-2.0
#include "session/setting_table.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace theatron::session {
namespace {

std::string_view kind_of(std::string_view codec) {
    return codec.substr(0, codec.find(':'));
}

}  // namespace

void SettingTable::wish(ParticipantId participant, std::string codec) {
    entries_[participant] = {std::move(codec), ""};
    update();
}

void SettingTable::stopgap(ParticipantId participant, std::string codec) {
    Entry& entry = entries_[participant];
    entry.stopgap = codec == entry.wish ? "" : std::move(codec);
    update();
}

void SettingTable::leave(ParticipantId participant) {
    entries_.erase(participant);
    update();
}

void SettingTable::pin(ParticipantId participant) {
    wish(participant, given(participant).codec);
}

bool SettingTable::is_active(const std::string& codec) const {
    return std::any_of(active_.begin(), active_.end(),
                       [&](const ActiveSetting& s) { return s.codec == codec; });
}

void SettingTable::update() {
    const auto used = [&](const std::string& codec, bool by_wish_only) {
        return std::any_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
            return entry.second.now() == codec && (!by_wish_only || entry.second.stopgap.empty());
        });
    };
    std::erase_if(active_, [&](const ActiveSetting& s) { return !used(s.codec, false); });

    // Participants are numbered as they join, so the longest present come first.
    for (const auto& [participant, entry] : entries_) {
        if (!entry.stopgap.empty() || is_active(entry.wish))
            continue;
        if (active_.size() >= max_active) {
            const auto stopgap =
                std::find_if(active_.rbegin(), active_.rend(),
                             [&](const ActiveSetting& s) { return !used(s.codec, true); });
            if (stopgap == active_.rend())
                continue;
            active_.erase(std::next(stopgap).base());
        }
        active_.push_back({SettingId(next_id_++), entry.wish});
    }
    for (const auto& [participant, entry] : entries_)
        if (!entry.stopgap.empty() && active_.size() < max_active && !is_active(entry.stopgap))
            active_.push_back({SettingId(next_id_++), entry.stopgap});
}

const ActiveSetting& SettingTable::given(ParticipantId participant) const {
    const auto entry = entries_.find(participant);
    assert(entry != entries_.end());
    const std::string& codec = entry->second.now();
    const auto same_kind = [&](const ActiveSetting& s) {
        return kind_of(s.codec) == kind_of(codec);
    };
    const auto exact = std::find_if(active_.begin(), active_.end(),
                                    [&](const ActiveSetting& s) { return s.codec == codec; });
    if (exact != active_.end())
        return *exact;
    if (!entry->second.stopgap.empty()) {
        // The youngest is most likely another stopgap, and as small.
        const auto near = std::find_if(active_.rbegin(), active_.rend(), same_kind);
        return near == active_.rend() ? active_.back() : *near;
    }
    const auto near = std::find_if(active_.begin(), active_.end(), same_kind);
    return near == active_.end() ? active_.front() : *near;
}

const std::string& SettingTable::wished(ParticipantId participant) const {
    const auto found = entries_.find(participant);
    assert(found != entries_.end());
    return found->second.wish;
}

}  // namespace theatron::session
