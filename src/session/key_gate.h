// SPDX-License-Identifier: Apache-2.0
// Lets chains of frames pass from a key frame on, and holds some of them back. Pure.
#pragma once

#include <set>
#include <utility>

#include "base/ids.h"
#include "wire/media_header.h"

namespace theatron::session {

class KeyGate {
public:
    // The frames of exactly these settings are held back from now on.
    void hold(std::set<SettingId> settings) {
        held_ = std::move(settings);
        for (const SettingId setting : held_)
            open_.erase(setting);
    }
    bool is_held(SettingId setting) const { return held_.contains(setting); }
    // A frame of this setting was lost: it goes on with a key frame.
    void interrupt(SettingId setting) { open_.erase(setting); }
    // False: the frame is to be left out. Where its setting is not held back, it needs a key frame.
    bool passes(const wire::MediaHeader& header) {
        if (is_held(header.setting))
            return false;
        if (header.key)
            open_.insert(header.setting);
        return open_.contains(header.setting);
    }

private:
    std::set<SettingId> held_;
    std::set<SettingId> open_;  // since a key frame
};

}  // namespace theatron::session
