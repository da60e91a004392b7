// SPDX-License-Identifier: Apache-2.0
#include "face/voice_mouth.h"

#include <algorithm>
#include <cmath>

#include "face/random.h"

namespace theatron::face {
namespace {

// A blink in each of these spans, at a place that the number of the span chooses.
constexpr double blink_span_s = 4, blink_s = 0.16, latest_blink_s = 3.5;

}  // namespace

float VoiceMouth::put(int level_db, TimePoint now) {
    const float share =
        std::clamp(float(level_db - quiet_db) / float(loud_db - quiet_db), 0.0F, 1.0F);
    const float wanted = widest * share * share * (3 - 2 * share);
    const Duration passed = at_ ? std::max(now - *at_, Duration::zero()) : Duration::zero();
    at_ = now;
    const Duration within = wanted > open_ ? opens_within : closes_within;
    open_ += (wanted - open_) * float(1 - std::exp(-to_seconds(passed) / to_seconds(within)));
    return open_;
}

float idle_blink(double seconds) {
    const double span = std::floor(seconds / blink_span_s);
    const double begins = latest_blink_s * Random(std::uint64_t(span)).unit();
    const double in = (seconds - span * blink_span_s - begins) / blink_s;
    return in > 0 && in < 1 ? float(1 - std::fabs(2 * in - 1)) : 0;
}

}  // namespace theatron::face
