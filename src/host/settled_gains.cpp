// SPDX-License-Identifier: Apache-2.0
#include "host/settled_gains.h"

#include <algorithm>
#include <cmath>

namespace theatron::host {
namespace {

// The largest difference of a channel, as a share.
double difference(Vec3 a, Vec3 b) {
    const auto of = [](double one, double other) { return std::abs(one / other - 1); };
    return std::max({of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)});
}

// Digits beyond these are noise.
double rounded(double factor) {
    return std::round(factor * 1000) / 1000;
}

}  // namespace

SettledGains::Gains SettledGains::add(const Gains& estimate, TimePoint now) {
    published_.resize(estimate.size());
    if (!is_visible_change(estimate)) {
        agreeing_.clear();
        return {};
    }
    if (!agrees(estimate))
        agreeing_.clear();
    if (agreeing_.empty())
        since_ = now;
    agreeing_.push_back(estimate);
    if (agreeing_.size() < enough_estimates || (has_published_ && now - since_ < lasting))
        return {};
    const Gains settled = mean();
    for (std::size_t i = 0; i < settled.size(); ++i)
        if (settled[i])
            published_[i] = settled[i];
    has_published_ = true;
    agreeing_.clear();
    return settled;
}

// Also the first gain of a camera.
bool SettledGains::is_visible_change(const Gains& estimate) const {
    for (std::size_t i = 0; i < estimate.size(); ++i)
        if (estimate[i] && (!published_[i] || difference(*estimate[i], *published_[i]) > visible))
            return true;
    return false;
}

bool SettledGains::agrees(const Gains& estimate) const {
    return std::all_of(agreeing_.begin(), agreeing_.end(), [&](const Gains& before) {
        for (std::size_t i = 0; i < estimate.size(); ++i)
            if (before[i].has_value() != estimate[i].has_value() ||
                (estimate[i] && difference(*estimate[i], *before[i]) > agreement))
                return false;
        return true;
    });
}

// All of them have gains of the same cameras.
SettledGains::Gains SettledGains::mean() const {
    Gains mean(agreeing_.front().size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
        if (!agreeing_.front()[i])
            continue;
        Vec3 sum;
        for (const Gains& one : agreeing_)
            sum = sum + *one[i];
        sum = sum * (1 / double(agreeing_.size()));
        mean[i] = Vec3{rounded(sum.x), rounded(sum.y), rounded(sum.z)};
    }
    return mean;
}

}  // namespace theatron::host
