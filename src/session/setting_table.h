// SPDX-License-Identifier: Apache-2.0
// Which encodings are made, and who gets which: each participant has a wish,
// each distinct wish is encoded once, and at most three are encoded at a time.
// A slow link may make do with another encoding for a while; such stopgaps only
// take places that no wish needs.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.h"

namespace theatron::session {

struct ActiveSetting {
    SettingId id{};
    std::string codec;
    bool operator==(const ActiveSetting&) const = default;
};

// One table for depth, one for colour. Pure and deterministic.
class SettingTable {
public:
    static constexpr std::size_t max_active = 3;

    // `first_id` is the number of the first setting; numbers are not reused.
    explicit SettingTable(SettingId first_id) : next_id_(std::uint16_t(first_id)) {}

    // `codec` must be in its one spelling, since equal texts share an encoder.
    void wish(ParticipantId participant, std::string codec);
    // Instead of the wish, until another is given; empty: none.
    void stopgap(ParticipantId participant, std::string codec);
    void leave(ParticipantId participant);
    // Its wish becomes what it gets, so that no other participant's doing changes that.
    void pin(ParticipantId participant);

    // In the order in which they became active.
    const std::vector<ActiveSetting>& active() const { return active_; }

    // What the participant gets: its wish, or where too many others are in use
    // the nearest (the same codec with other parameters, else the oldest).
    // The participant must have a wish.
    const ActiveSetting& given(ParticipantId participant) const;
    const std::string& wished(ParticipantId participant) const;

private:
    struct Entry {
        std::string wish, stopgap;
        const std::string& now() const { return stopgap.empty() ? wish : stopgap; }
    };

    void update();
    bool is_active(const std::string& codec) const;

    std::map<ParticipantId, Entry> entries_;
    std::vector<ActiveSetting> active_;
    std::uint16_t next_id_;
};

}  // namespace theatron::session
