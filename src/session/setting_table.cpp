// SPDX-License-Identifier: Apache-2.0
#include "session/setting_table.h"

#include <algorithm>
#include <cassert>

namespace theatron::session {
namespace {

std::string_view kind_of(std::string_view codec) {
    return codec.substr(0, codec.find(':'));
}

}  // namespace

void SettingTable::wish(ParticipantId participant, std::string codec) {
    wishes_[participant] = std::move(codec);
    update();
}

void SettingTable::leave(ParticipantId participant) {
    wishes_.erase(participant);
    update();
}

void SettingTable::update() {
    const auto wanted = [&](std::string_view codec) {
        return std::any_of(wishes_.begin(), wishes_.end(),
                           [&](const auto& entry) { return entry.second == codec; });
    };
    std::erase_if(active_, [&](const ActiveSetting& s) { return !wanted(s.codec); });

    // Participants are numbered as they join, so the longest present come first.
    for (const auto& wish : wishes_) {
        const std::string& codec = wish.second;
        const bool present = std::any_of(active_.begin(), active_.end(),
                                         [&](const ActiveSetting& s) { return s.codec == codec; });
        if (!present && active_.size() < max_active)
            active_.push_back({SettingId(next_id_++), codec});
    }
}

const ActiveSetting& SettingTable::given(ParticipantId participant) const {
    const std::string& codec = wished(participant);
    const auto find = [&](auto matches) {
        return std::find_if(active_.begin(), active_.end(), matches);
    };
    auto found = find([&](const ActiveSetting& s) { return s.codec == codec; });
    if (found == active_.end())
        found = find([&](const ActiveSetting& s) { return kind_of(s.codec) == kind_of(codec); });
    return found == active_.end() ? active_.front() : *found;
}

const std::string& SettingTable::wished(ParticipantId participant) const {
    const auto found = wishes_.find(participant);
    assert(found != wishes_.end());
    return found->second;
}

}  // namespace theatron::session
