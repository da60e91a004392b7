// SPDX-License-Identifier: Apache-2.0
// The encoded bytes a second of each setting, by temporal layer. A setting belongs to
// one stream.
#pragma once

#include <algorithm>
#include <array>
#include <map>

#include "base/ids.h"
#include "base/statistics.h"

namespace theatron::session {

// Number of layers that receivers are served: 0 a quarter, 1 half, 2 all of the frames.
inline constexpr int served_layers = 3;

class StreamRates {
public:
    void add(SettingId setting, int layer, std::size_t bytes, TimePoint now) {
        const auto [found, fresh] = rates_.try_emplace(setting);
        if (fresh)
            found->second.began = now;
        found->second.by_layer[std::size_t(layer)].add(now, double(bytes));
    }

    // The rate of layers 0 to `highest` together.
    double bytes_per_second(SettingId setting, int highest, TimePoint now) {
        const auto found = rates_.find(setting);
        if (found == rates_.end())
            return 0;
        // Young rates have not seen a whole second; the first frame is no rate yet.
        const double seen = std::clamp(to_seconds(now - found->second.began), 0.2, 1.0);
        double sum = 0;
        for (int layer = 0; layer <= highest; ++layer)
            sum += found->second.by_layer[std::size_t(layer)].per_second(now) / seen;
        return sum;
    }

    void forget(SettingId setting) { rates_.erase(setting); }

private:
    struct Rate {
        std::array<RateWindow, served_layers> by_layer;
        TimePoint began;
    };
    std::map<SettingId, Rate> rates_;
};

}  // namespace theatron::session
