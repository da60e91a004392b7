// SPDX-License-Identifier: Apache-2.0
#include "compare_link.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "simulation/simulated_link.h"

namespace theatron::bench {
namespace {

constexpr double sent_seconds = 10;

Duration milliseconds(double value) {
    return seconds_to_duration(value / 1000);
}

struct ArrivedMoment {
    TimePoint captured, arrived;
    Duration decoding;
};

std::vector<ArrivedMoment> arrivals(const CompareLink& wanted,
                                    const std::vector<SentMoment>& moments, double moments_per_s) {
    theatron::testing::SimulatedLink link(1);
    link.bytes_per_second = wanted.mbit * 1e6 / 8;
    link.delay = milliseconds(wanted.latency_ms);
    const auto captured = [&](int number) {
        return TimePoint(seconds_to_duration(number / moments_per_s));
    };
    const int count = int(sent_seconds * moments_per_s);
    std::vector<ArrivedMoment> result;
    TimePoint sender_free{};
    int next = 0;
    for (std::size_t sent = 0; next < count; ++sent) {
        const std::size_t rest = std::max<std::size_t>(moments.size() - 1, 1);
        const SentMoment& moment =
            moments[sent < moments.size() ? sent : moments.size() - rest + (sent - 1) % rest];
        const Duration encoding = milliseconds(moment.sender_ms);
        const TimePoint start = std::max({captured(next), sender_free, link.free_at() - encoding});
        while (next + 1 < count && captured(next + 1) <= start)
            ++next;
        sender_free = start + encoding;
        link.send(Bytes(moment.bytes), sender_free);
        const TimePoint arrived = link.next_arrival().value();
        Bytes taken;
        (void)link.receive(taken, arrived);
        result.push_back({captured(next), arrived, milliseconds(moment.receiver_ms)});
        ++next;
    }
    return result;
}

}  // namespace

LinkFigures sent_over(const CompareLink& link, const std::vector<SentMoment>& moments,
                      double moments_per_s) {
    const std::vector<ArrivedMoment> all = arrivals(link, moments, moments_per_s);
    std::vector<double> ages;
    TimePoint receiver_free{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool newer_is_there = i + 1 < all.size() && all[i + 1].arrived <= receiver_free;
        if (newer_is_there)
            continue;
        receiver_free = std::max(receiver_free, all[i].arrived) + all[i].decoding;
        ages.push_back(to_ms(receiver_free - all[i].captured));
    }
    double sum = 0;
    for (const double age : ages)
        sum += age;
    return {link, double(ages.size()) / sent_seconds, sum / double(ages.size()),
            percentile(ages, 0.95)};
}

}  // namespace theatron::bench
