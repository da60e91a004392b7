// SPDX-License-Identifier: Apache-2.0
#include "base/moment_meter.h"

#include <algorithm>

namespace theatron {
namespace {

// Differences of such times cannot overflow.
bool is_possible(TimePoint time) {
    constexpr std::int64_t most = std::int64_t(1) << 61;
    return to_us(time) > -most && to_us(time) < most;
}

template <class Exposures>
bool contains(const Exposures& exposures, CameraId camera) {
    return std::any_of(exposures.begin(), exposures.end(),
                       [camera](const auto& one) { return one.camera == camera; });
}

}  // namespace

void MomentMeter::add(ParticipantId publisher, CameraId camera, TimePoint moment,
                      TimePoint captured) {
    if (!is_possible(moment) || !is_possible(captured))
        return;
    if (!publishers_.contains(publisher) && publishers_.size() >= most_publishers)
        publishers_.erase(std::min_element(
            publishers_.begin(), publishers_.end(),
            [](const auto& a, const auto& b) { return a.second.newest < b.second.newest; }));
    Publisher& of = publishers_[publisher];
    if (moment + long_before < of.newest)
        of = {};
    of.newest = std::max(of.newest, moment);
    const bool is_late = of.open.size() == open_moments && moment < of.open.begin()->first;
    if (is_late)
        return;
    Running& running = of.cameras.try_emplace(camera, Running{moment, moment}).first->second;
    running.first = std::min(running.first, moment);
    running.newest = std::max(running.newest, moment);
    auto open = of.open.find(moment);
    if (open == of.open.end() && of.open.size() == open_moments) {
        // The memory of the oldest one is used again.
        close_first(of);
        auto oldest = of.open.extract(of.open.begin());
        oldest.key() = moment;
        oldest.mapped().clear();
        open = of.open.insert(std::move(oldest)).position;
    } else if (open == of.open.end()) {
        open = of.open.try_emplace(moment).first;
    }
    std::vector<Exposure>& exposures = open->second;
    if (!contains(exposures, camera))
        exposures.push_back({camera, captured});
}

// A camera that began later, or has stopped, is not missed.
void MomentMeter::close_first(Publisher& publisher) {
    const auto& [moment, exposures] = *publisher.open.begin();
    std::erase_if(publisher.cameras, [now = moment](const auto& entry) {
        return entry.second.newest + long_before < now;
    });
    std::size_t expected = 0;
    for (const auto& [camera, running] : publisher.cameras)
        expected +=
            contains(exposures, camera) || (running.first < moment && running.newest > moment);
    if (expected > exposures.size()) {
        counts_.unpaired += exposures.size();
    } else if (expected > 1) {
        const auto [first, last] = std::minmax_element(
            exposures.begin(), exposures.end(),
            [](const Exposure& a, const Exposure& b) { return a.captured < b.captured; });
        const double skew_ms = to_ms(last->captured - first->captured);
        counts_.skew_max_ms = std::max(counts_.skew_max_ms, skew_ms);
        ++counts_.whole;
        ++skews_[std::min(std::size_t(skew_ms / bin_ms), bins - 1)];
    }
}

MomentFigures MomentMeter::figures() const {
    MomentFigures figures = counts_;
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < bins && 2 * below < counts_.whole; ++i) {
        below += skews_[i];
        figures.skew_p50_ms = std::min(double(i) * bin_ms, counts_.skew_max_ms);
    }
    return figures;
}

void MomentMeter::reset() {
    *this = {};
}

}  // namespace theatron
