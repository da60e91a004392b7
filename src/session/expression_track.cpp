// SPDX-License-Identifier: Apache-2.0
#include "session/expression_track.h"

#include <algorithm>

namespace theatron::session {
namespace {

template <std::size_t N>
std::array<float, N> mixed(const std::array<float, N>& a, const std::array<float, N>& b,
                           float share) {
    std::array<float, N> result{};
    for (std::size_t i = 0; i < N; ++i)
        result[i] = a[i] + share * (b[i] - a[i]);
    return result;
}

// A face that sends all channels and one that does not have no way between them.
wire::FaceExpression between(const wire::FaceExpression& from, const wire::FaceExpression& to,
                             float share) {
    wire::FaceExpression result = to;
    const auto mix = [&](float a, float b) { return a + share * (b - a); };
    result.emotions = mixed(from.emotions, to.emotions, share);
    result.jaw_open = mix(from.jaw_open, to.jaw_open);
    result.blink_left = mix(from.blink_left, to.blink_left);
    result.blink_right = mix(from.blink_right, to.blink_right);
    if (from.channels && to.channels)
        result.channels = mixed(*from.channels, *to.channels, share);
    return result;
}

wire::FaceExpression at_rest(const wire::FaceExpression& of) {
    wire::FaceExpression rest;
    rest.time = of.time;
    rest.state = of.state;
    rest.emotions.back() = 1;
    if (of.channels)
        rest.channels.emplace();
    return rest;
}

float share_of(Duration passed, Duration whole) {
    return float(std::clamp(to_seconds(passed) / to_seconds(whole), 0.0, 1.0));
}

}  // namespace

void ExpressionTrack::add(const wire::FaceExpression& expression, TimePoint now) {
    if (to_ && expression.time <= to_->time)
        return;
    const auto shown = at(now);
    from_ = shown ? *shown : at_rest(expression);
    to_ = expression;
    arrived_ = now;
}

std::optional<wire::FaceExpression> ExpressionTrack::at(TimePoint now) const {
    if (!to_ || now - arrived_ >= gone_after)
        return std::nullopt;
    const wire::FaceExpression shown = between(from_, *to_, share_of(now - arrived_, way));
    const Duration silent = now - arrived_ - silent_after;
    return silent <= Duration::zero()
               ? shown
               : between(shown, at_rest(*to_), share_of(silent, neutral_after - silent_after));
}

bool ExpressionTrack::is_moving(TimePoint now) const {
    const Duration age = now - arrived_;
    return to_ && (age < way || (age >= silent_after && age < neutral_after));
}

}  // namespace theatron::session
