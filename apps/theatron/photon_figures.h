// SPDX-License-Identifier: Apache-2.0
// The figures of `theatron photon` as JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "photon/latency.h"

namespace theatron::app {

// Rounded to tenths, as all milliseconds are printed.
inline double tenths(double value) {
    return std::round(value * 10) / 10;
}

inline nlohmann::json spread_json(const photon::Spread& spread) {
    return {{"mean", tenths(spread.mean)},   {"median", tenths(spread.median)},
            {"p5", tenths(spread.p5)},       {"p95", tenths(spread.p95)},
            {"least", tenths(spread.least)}, {"most", tenths(spread.most)}};
}

}  // namespace theatron::app
