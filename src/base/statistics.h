// SPDX-License-Identifier: Apache-2.0
// Small figures for status lines and benchmarks: percentiles over a bounded
// window. Not thread safe; each owner keeps its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <vector>

#include "base/time.h"

namespace theatron {

// The value below which the share `q` (0 to 1) of `values` lies; 0 when empty.
inline double percentile(std::vector<double> values, double q) {
    if (values.empty())
        return 0;
    const auto rank = std::size_t(q * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
    return values[rank];
}

inline double median(std::vector<double> values) {
    return percentile(std::move(values), 0.5);
}

// Keeps the newest `capacity` samples.
class SampleWindow {
public:
    explicit SampleWindow(std::size_t capacity) : capacity_(capacity) {}

    void add(double value) {
        if (values_.size() < capacity_)
            values_.push_back(value);
        else
            values_[next_ % capacity_] = value;
        ++next_;
    }
    void clear() {
        values_.clear();
        next_ = 0;
    }
    bool empty() const { return values_.empty(); }
    double percentile(double q) const { return theatron::percentile(values_, q); }
    double max() const {
        return values_.empty() ? 0 : *std::max_element(values_.begin(), values_.end());
    }

private:
    std::size_t capacity_;
    std::size_t next_ = 0;
    std::vector<double> values_;
};

// Counts durations by size, for monitoring: upper bounds in seconds as Prometheus has them.
class Histogram {
public:
    static constexpr double bounds[] = {0.0005, 0.001, 0.002, 0.004, 0.008, 0.016,
                                        0.033,  0.066, 0.125, 0.25,  0.5,   1};
    static constexpr std::size_t bound_count = sizeof(bounds) / sizeof(bounds[0]);

    void add(double seconds) {
        ++counts_[std::size_t(std::lower_bound(std::begin(bounds), std::end(bounds), seconds) -
                              std::begin(bounds))];
        ++count_;
        sum_ += seconds;
    }
    std::uint64_t count() const { return count_; }
    double sum() const { return sum_; }
    // Number of durations of at most bounds[i].
    std::uint64_t at_most(std::size_t i) const {
        std::uint64_t total = 0;
        for (std::size_t b = 0; b <= i; ++b)
            total += counts_[b];
        return total;
    }

private:
    std::uint64_t counts_[bound_count + 1] = {};
    std::uint64_t count_ = 0;
    double sum_ = 0;
};

// Sum of the amounts of the last second.
class RateWindow {
public:
    void add(TimePoint now, double amount = 1) {
        forget(now);
        events_.push_back({now, amount});
        sum_ += amount;
    }
    double per_second(TimePoint now) {
        forget(now);
        return events_.empty() ? 0 : sum_;
    }

private:
    struct Event {
        TimePoint time;
        double amount;
    };
    void forget(TimePoint now) {
        while (!events_.empty() && events_.front().time <= now - Duration(1'000'000)) {
            sum_ -= events_.front().amount;
            events_.pop_front();
        }
    }
    std::deque<Event> events_;
    double sum_ = 0;
};

}  // namespace theatron
