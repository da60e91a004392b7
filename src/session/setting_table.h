// SPDX-License-Identifier: Apache-2.0
// Chooses the active encodings and assigns one to each participant. Each participant
// has a wish, and each distinct wish is encoded once. At most three are encoded at a
// time, besides the usual one, whose place is reserved. A participant with a slow link
// may get another encoding for a while; such stopgaps only take places that no wish
// needs. Those who wish for nothing (wire/no_codec.h) get a setting that is never active, and take
// no place.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "session/ladder.h"
#include "session/setting_numbers.h"

namespace theatron::session {

struct ActiveSetting {
    SettingId id{};
    std::string codec;
    CodecTraits traits;  // of `codec`
    bool operator==(const ActiveSetting& other) const {
        return id == other.id && codec == other.codec;
    }
};

// One table for depth and one for colour of each camera. Pure and deterministic.
class SettingTable {
public:
    static constexpr std::size_t max_active = 3;  // besides the usual one

    // `usual` is the codec with the reserved place, in canonical spelling; empty: none.
    // `numbers`, common to all tables of a session, must outlive the table. `traits` reads the text
    // of a codec, once for each setting that becomes active; empty: no setting has traits.
    using ReadTraits = std::function<CodecTraits(const std::string&)>;
    explicit SettingTable(SettingNumbers& numbers, std::string usual = "", ReadTraits traits = {})
        : numbers_(numbers), usual_(std::move(usual)), traits_(std::move(traits)) {}
    SettingTable(SettingTable&&) = delete;
    ~SettingTable();

    // `codec` must be in canonical spelling, because equal texts share an encoder.
    void wish(ParticipantId participant, std::string codec);
    // Replaces the wish until the next call; empty: no stopgap.
    void stopgap(ParticipantId participant, std::string codec);
    void leave(ParticipantId participant);
    // Sets its wish to given(), so that other participants cannot change what it gets.
    void pin(ParticipantId participant);
    // `is_slow`: its encoder does not keep up with the cameras, so it never replaces another wish.
    void set_slow(SettingId setting, bool is_slow);

    // See CodecTraits. Does nothing if the setting is not active.
    void note_chain(SettingId setting, bool chain);

    // In the order in which they became active.
    const std::vector<ActiveSetting>& active() const { return active_; }
    // Null if it is not active.
    const ActiveSetting* find(SettingId setting) const;

    // The setting that the participant gets: its wish, or if too many others are in use the
    // nearest one (the same codec with other parameters, else the usual one, else the oldest).
    // The participant must have a wish.
    const ActiveSetting& given(ParticipantId participant) const;
    const std::string& wished(ParticipantId participant) const;
    bool has_wish(ParticipantId participant) const { return entries_.contains(participant); }

private:
    struct Entry {
        std::string wish, stopgap;
        const std::string& now() const { return stopgap.empty() ? wish : stopgap; }
    };

    using Active = std::vector<ActiveSetting>;

    void update();
    void update_nothing();
    void add(const std::string& codec);
    void remove(Active::iterator setting);
    bool is_active(const std::string& codec) const;
    // True if `codec` may become active: the usual one always, others while a place is free.
    bool has_place(const std::string& codec) const;
    const ActiveSetting* find(const std::string& codec) const;
    const ActiveSetting* nearest(const Entry& entry) const;

    SettingNumbers& numbers_;
    const std::string usual_;
    const ReadTraits traits_;
    std::map<ParticipantId, Entry> entries_;
    Active active_;
    std::optional<ActiveSetting> nothing_;  // of those who wish for it; else none
    std::set<SettingId> slow_;
};

}  // namespace theatron::session
