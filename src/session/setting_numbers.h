// SPDX-License-Identifier: Apache-2.0
// Numbers for settings of depth and colour alike. A number is never 0 and never given twice at
// the same time; see docs/decisions/setting-numbers.md for when one comes again.
#pragma once

#include <cassert>
#include <set>

#include "base/ids.h"

namespace theatron::session {

class SettingNumbers {
public:
    static constexpr std::size_t how_many = 0xffff;  // 1 to 65535

    // The next number that is not in use, in a circle: each of the others is given before one
    // comes again.
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
