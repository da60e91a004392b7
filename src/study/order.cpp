// SPDX-License-Identifier: Apache-2.0
#include "study/order.h"

#include <cassert>
#include <numeric>
#include <utility>

#include "base/split_mix.h"

namespace theatron::study {
namespace {

// Fisher and Yates.
std::vector<std::size_t> permutation(std::size_t count, SplitMix& random) {
    std::vector<std::size_t> places(count);
    std::iota(places.begin(), places.end(), std::size_t(0));
    for (std::size_t i = count; i > 1; --i)
        std::swap(places[i - 1], places[std::size_t(random.below(i))]);
    return places;
}

}  // namespace

std::vector<std::vector<std::size_t>> williams_design(std::size_t count) {
    std::vector<std::vector<std::size_t>> rows;
    for (std::size_t row = 0; row < count; ++row) {
        // 0, 1, n-1, 2, n-2, ... moved on by the row.
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t step = i % 2 == 1 ? (i + 1) / 2 : (count - i / 2) % count;
            places.push_back((step + row) % count);
        }
        rows.push_back(std::move(places));
    }
    if (count % 2 == 1 && count > 1)
        for (std::size_t row = 0; row < count; ++row)
            rows.emplace_back(rows[row].rbegin(), rows[row].rend());
    return rows;
}

std::vector<std::size_t> condition_order(Order order, std::size_t conditions, std::uint64_t seed,
                                         int participant) {
    assert(participant >= 1);
    const auto number = std::uint64_t(participant - 1);
    std::vector<std::size_t> places(conditions);
    std::iota(places.begin(), places.end(), std::size_t(0));
    if (conditions < 2 || order == Order::as_written)
        return places;
    if (order == Order::random) {
        SplitMix random(mixed(seed) + number);
        return permutation(conditions, random);
    }
    const auto rows = williams_design(conditions);
    SplitMix of_study(mixed(seed ^ 0x5175617265));
    const auto names = permutation(conditions, of_study);
    SplitMix of_group(mixed(seed) + number / rows.size());
    const auto rows_in_turn = permutation(rows.size(), of_group);
    for (std::size_t i = 0; i < conditions; ++i)
        places[i] = names[rows[rows_in_turn[number % rows.size()]][i]];
    return places;
}

}  // namespace theatron::study
