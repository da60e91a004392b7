// SPDX-License-Identifier: Apache-2.0
#include "session/setting_table.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "wire/no_codec.h"

namespace theatron::session {
namespace {

std::string_view kind_of(std::string_view codec) {
    return codec.substr(0, codec.find(':'));
}

}  // namespace

SettingTable::~SettingTable() {
    for (const ActiveSetting& setting : active_)
        numbers_.give_back(setting.id);
    if (nothing_)
        numbers_.give_back(nothing_->id);
}

void SettingTable::wish(ParticipantId participant, std::string codec) {
    entries_[participant] = {std::move(codec), ""};
    update();
}

void SettingTable::stopgap(ParticipantId participant, std::string codec) {
    const auto found = entries_.find(participant);
    assert(found != entries_.end());
    Entry& entry = found->second;
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

void SettingTable::set_slow(SettingId setting, bool is_slow) {
    if (is_slow)
        slow_.insert(setting);
    else
        slow_.erase(setting);
    update();
}

void SettingTable::note_chain(SettingId setting, bool chain) {
    for (ActiveSetting& active : active_)
        if (active.id == setting)
            active.traits.chain = chain;
}

const ActiveSetting* SettingTable::find(const std::string& codec) const {
    const auto found = std::find_if(active_.begin(), active_.end(),
                                    [&](const ActiveSetting& s) { return s.codec == codec; });
    return found == active_.end() ? nullptr : &*found;
}

const ActiveSetting* SettingTable::find(SettingId setting) const {
    const auto found = std::find_if(active_.begin(), active_.end(),
                                    [&](const ActiveSetting& s) { return s.id == setting; });
    return found == active_.end() ? nullptr : &*found;
}

bool SettingTable::is_active(const std::string& codec) const {
    return find(codec) != nullptr;
}

bool SettingTable::has_place(const std::string& codec) const {
    const auto others = std::count_if(active_.begin(), active_.end(),
                                      [&](const ActiveSetting& s) { return s.codec != usual_; });
    return codec == usual_ || std::size_t(others) < max_active;
}

void SettingTable::add(const std::string& codec) {
    active_.push_back({numbers_.take(), codec, traits_ ? traits_(codec) : CodecTraits{}});
}

void SettingTable::remove(Active::iterator setting) {
    numbers_.give_back(setting->id);
    slow_.erase(setting->id);
    active_.erase(setting);
}

void SettingTable::update_nothing() {
    const bool is_wished = std::any_of(entries_.begin(), entries_.end(), [](const auto& entry) {
        return entry.second.wish == wire::no_codec;
    });
    if (is_wished && !nothing_) {
        nothing_ = ActiveSetting{numbers_.take(), std::string(wire::no_codec), {}};
    } else if (!is_wished && nothing_) {
        numbers_.give_back(nothing_->id);
        nothing_.reset();
    }
}

void SettingTable::update() {
    update_nothing();
    const auto used = [&](const std::string& codec, bool by_wish_only) {
        return std::any_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
            return entry.second.now() == codec && (!by_wish_only || entry.second.stopgap.empty());
        });
    };
    // The usual setting may still replace others; this is decided last.
    for (std::size_t i = active_.size(); i-- > 0;)
        if (active_[i].codec != usual_ && !used(active_[i].codec, false))
            remove(active_.begin() + std::ptrdiff_t(i));

    // Participants are numbered as they join, so the longest present come first.
    for (const auto& [participant, entry] : entries_) {
        if (!entry.stopgap.empty() || entry.wish == wire::no_codec || is_active(entry.wish))
            continue;
        if (!has_place(entry.wish)) {
            const auto stopgap = std::find_if(
                active_.rbegin(), active_.rend(),
                [&](const ActiveSetting& s) { return s.codec != usual_ && !used(s.codec, true); });
            if (stopgap == active_.rend())
                continue;
            remove(std::next(stopgap).base());
        }
        add(entry.wish);
    }
    for (const auto& [participant, entry] : entries_)
        if (!entry.stopgap.empty() && !is_active(entry.stopgap) && has_place(entry.stopgap))
            add(entry.stopgap);

    if (usual_.empty())
        return;
    const bool wanted =
        used(usual_, false) || std::any_of(entries_.begin(), entries_.end(), [&](const auto& e) {
            return nearest(e.second) == nullptr || nearest(e.second)->codec == usual_;
        });
    const auto usual = std::find_if(active_.begin(), active_.end(),
                                    [&](const ActiveSetting& s) { return s.codec == usual_; });
    if (wanted && usual == active_.end())
        add(usual_);
    else if (!wanted && usual != active_.end())
        remove(usual);
}

// Null for the usual setting while it is not active.
const ActiveSetting* SettingTable::nearest(const Entry& entry) const {
    if (entry.wish == wire::no_codec)
        return &*nothing_;
    const std::string& codec = entry.now();
    if (const ActiveSetting* exact = find(codec))
        return exact;
    const auto can_stand_in = [&](const ActiveSetting& s) {
        return kind_of(s.codec) == kind_of(codec) && !slow_.contains(s.id);
    };
    if (!entry.stopgap.empty() && !active_.empty()) {
        // The newest setting is most likely another stopgap of similar size.
        const auto near = std::find_if(active_.rbegin(), active_.rend(), can_stand_in);
        return near == active_.rend() ? &active_.back() : &*near;
    }
    const auto near = std::find_if(active_.begin(), active_.end(), can_stand_in);
    if (near != active_.end())
        return &*near;
    return usual_.empty() ? &active_.front() : find(usual_);
}

const ActiveSetting& SettingTable::given(ParticipantId participant) const {
    const auto entry = entries_.find(participant);
    assert(entry != entries_.end());
    const ActiveSetting* setting = nearest(entry->second);
    assert(setting);
    return *setting;
}

const std::string& SettingTable::wished(ParticipantId participant) const {
    const auto found = entries_.find(participant);
    assert(found != entries_.end());
    return found->second.wish;
}

}  // namespace theatron::session
