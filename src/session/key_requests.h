// SPDX-License-Identifier: Apache-2.0
// Key frames are large: however many receivers ask, each stream of a setting
// makes at most one per half second. A request that comes too early waits.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/time.h"

namespace theatron::session {

class KeyRequests {
public:
    static constexpr Duration min_interval = std::chrono::milliseconds(500);

    struct Key {
        StreamId stream{};
        SettingId setting{};
        auto operator<=>(const Key&) const = default;
    };

    void request(Key key) { waiting_.insert(key); }

    // The requests that may be passed on now. Call again later for the others.
    std::vector<Key> take(TimePoint now) {
        std::vector<Key> due;
        for (auto it = waiting_.begin(); it != waiting_.end();) {
            const auto last = last_.find(*it);
            if (last != last_.end() && now - last->second < min_interval) {
                ++it;
                continue;
            }
            last_[*it] = now;
            due.push_back(*it);
            it = waiting_.erase(it);
        }
        return due;
    }

    // Forgets a setting that is no longer encoded.
    void forget(SettingId setting) {
        std::erase_if(waiting_, [&](const Key& k) { return k.setting == setting; });
        std::erase_if(last_, [&](const auto& entry) { return entry.first.setting == setting; });
    }

private:
    std::set<Key> waiting_;
    std::map<Key, TimePoint> last_;
};

}  // namespace theatron::session
