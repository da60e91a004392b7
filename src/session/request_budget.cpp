// SPDX-License-Identifier: Apache-2.0
#include "session/request_budget.h"

#include <algorithm>
#include <utility>

namespace theatron::session {
namespace {

template <std::size_t... kind>
std::array<TokenBucket, RequestBudget::kinds> full_buckets(double streams,
                                                           std::index_sequence<kind...>) {
    const auto full = [&](std::size_t k) {
        const double times = RequestBudget::Kind(k) == RequestBudget::Kind::key ? streams : 1;
        return TokenBucket(RequestBudget::limits[k].per_second * times,
                           RequestBudget::limits[k].at_once * times);
    };
    return {full(kind)...};
}

}  // namespace

void TokenBucket::fill(TimePoint now) {
    if (std::exchange(began_, true) && now > filled_)
        tokens_ = std::min(most_, tokens_ + to_seconds(now - filled_) * per_second_);
    filled_ = std::max(filled_, now);
}

bool TokenBucket::take(TimePoint now, double tokens) {
    fill(now);
    if (tokens_ < tokens)
        return false;
    tokens_ -= tokens;
    return true;
}

void TokenBucket::owe(double tokens, TimePoint now) {
    fill(now);
    tokens_ = std::max(tokens_ - tokens, -most_);
}

void TokenBucket::set_limit(double per_second, double most) {
    tokens_ = std::min(most, tokens_ + std::max(most - most_, 0.0));
    per_second_ = per_second;
    most_ = most;
}

void RequestBudget::set_streams(std::size_t streams) {
    const double times = double(std::max(streams, std::size_t(1)));
    const Limit limit = limits[std::size_t(Kind::key)];
    bucket(Kind::key).set_limit(limit.per_second * times, limit.at_once * times);
}

RequestBudget::RequestBudget(std::size_t streams)
    : buckets_(full_buckets(double(std::max(streams, std::size_t(1))),
                            std::make_index_sequence<kinds>())) {}

RequestBudget::Answer RequestBudget::ask(Kind kind, TimePoint now) {
    if (bucket(kind).take(now))
        return Answer::granted;
    ++refused_;
    return patience_.take(now) ? Answer::too_often : Answer::flood;
}

}  // namespace theatron::session
