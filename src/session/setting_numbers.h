// SPDX-License-Identifier: Apache-2.0
// Numbers for settings of depth and colour. A number is never 0 and never used twice at the same
// time; docs/decisions/setting-numbers.md explains when one is used again.
#pragma once

#include <cassert>
#include <set>

#include "base/ids.h"

namespace theatron::session {

class SettingNumbers {
public:
    static constexpr std::size_t how_many = 0xffff;  // 1 to 65535

    // The next unused number, in a circle: all other unused numbers are returned before one is
    // returned again.
    SettingId take() {
        assert(used_.size() < how_many);
        do
            last_ = SettingId(std::uint16_t(last_) == how_many ? 1 : int(last_) + 1);
        while (!used_.insert(last_).second);
        return last_;
    }
    void give_back(SettingId number) { used_.erase(number); }

private:
    SettingId last_{};
    std::set<SettingId> used_;
};

}  // namespace theatron::session
