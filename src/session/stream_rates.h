// SPDX-License-Identifier: Apache-2.0
// What is encoded of each setting, in bytes a second, by temporal layer: what a
// receiver's share of it would take.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/ids.h"
#include "base/statistics.h"

namespace theatron::session {

// Layers that a receiver can be served up to: 0 a quarter, 1 half, 2 all frames.
inline constexpr int served_layers = 3;

class StreamRates {
public:
    void add(StreamId stream, SettingId setting, int layer, std::size_t bytes, TimePoint now) {
        const auto [found, fresh] = rates_.try_emplace({setting, stream});
        if (fresh)
            found->second.began = now;
        found->second.by_layer[std::size_t(layer)].add(now, double(bytes));
    }

    // Of all streams of the setting together, layers 0 to `highest`.
    double bytes_per_second(SettingId setting, int highest, TimePoint now) {
        double sum = 0;
        for (auto& [key, rate] : rates_) {
            if (key.first != setting)
                continue;
            // Young rates have not seen a whole second; the first frame is no rate yet.
            const double seen = std::clamp(to_seconds(now - rate.began), 0.2, 1.0);
            for (int layer = 0; layer <= highest; ++layer)
                sum += rate.by_layer[std::size_t(layer)].per_second(now) / seen;
        }
        return sum;
    }

    void forget(SettingId setting) {
        std::erase_if(rates_, [&](const auto& entry) { return entry.first.first == setting; });
    }

private:
    struct Rate {
        std::array<RateWindow, served_layers> by_layer;
        TimePoint began;
    };
    std::map<std::pair<SettingId, StreamId>, Rate> rates_;
};

}  // namespace theatron::session
