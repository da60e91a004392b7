// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace theatron::codec::strata {
namespace {

constexpr std::size_t all_depths = 65536;

std::vector<std::uint8_t> presence(DepthView depth) {
    std::vector<std::uint8_t> present(all_depths);
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* row = depth.row(y);
        for (int x = 0; x < depth.size.width; ++x)
            present[row[x]] = 1;
    }
    present[0] = present[all_depths - 1] = 0;
    return present;
}

Values listed(const std::vector<std::uint8_t>& present) {
    Values values;
    for (std::size_t v = 0; v < all_depths; ++v) {
        if (present[v] != 0)
            values.push_back(std::uint16_t(v));
    }
    return values;
}

constexpr std::uint16_t no_rank = 0x7fff;

// Each depth's rank, no_rank where it has none.
void make_ranks(const Values& values, std::vector<std::uint16_t>& ranks) {
    ranks.assign(all_depths, no_rank);
    ranks[0] = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        ranks[values[i]] = std::uint16_t(first_rank + i);
    ranks[all_depths - 1] = 65535;
}

}  // namespace

Values find_values(DepthView depth, Tolerance tolerance) {
    Values values = listed(presence(depth));
    if (values.empty() || values.size() > max_values)
        return {};
    // Bits that ranks save: those of the distance to the next value. The tolerance
    // would save those of its width. A sample of the pixels says how often.
    std::vector<std::uint16_t> ranks;
    make_ranks(values, ranks);
    double saved = 0;
    for (int y = 1; y < depth.size.height; y += 4) {
        for (int x = y % 3; x < depth.size.width; x += 3) {
            const unsigned d = depth.row(y)[x];
            const std::size_t i = std::size_t(ranks[d]) - first_rank;
            if (i + 1 >= values.size())
                continue;
            const double width = 1 + 2 * (tolerance.constant + tolerance.squared * (d * d >> 20));
            saved += 12 * (std::log2(double(values[i + 1] - values[i])) - std::log2(width));
        }
    }
    const double pixels = double(depth.size.area());
    const double cost = 10.0 * double(values.size());
    if (saved < cost + 0.25 * pixels)
        values.clear();
    return values;
}

bool add_values(DepthView depth, Values& values) {
    std::vector<std::uint8_t> known(all_depths);
    for (const std::uint16_t v : values)
        known[v] = 1;
    known[0] = known[all_depths - 1] = 1;
    bool complete = true;
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* row = depth.row(y);
        std::uint8_t all = 1;
        for (int x = 0; x < depth.size.width; ++x)
            all &= known[row[x]];
        if (all != 0)
            continue;
        complete = false;
        for (int x = 0; x < depth.size.width; ++x)
            known[row[x]] = 1;
    }
    if (complete)
        return true;
    known[0] = known[all_depths - 1] = 0;
    values = listed(known);
    return values.size() <= max_values;
}

void put_values(const Values& before, const Values& values, SideWriter& side) {
    NumberModel counts, gaps;
    Values added;
    std::set_difference(values.begin(), values.end(), before.begin(), before.end(),
                        std::back_inserter(added));
    counts.put(unsigned(added.size()), side);
    unsigned last = 0;
    for (const std::uint16_t v : added) {
        gaps.put(v - last - 1, side);
        last = v;
    }
}

bool get_values(const Values& before, Values& values, SideReader& side) {
    NumberModel counts, gaps;
    const unsigned count = counts.get(side);
    if (count + before.size() > max_values)
        return false;
    Values added;
    unsigned last = 0;
    for (unsigned i = 0; i < count; ++i) {
        last += gaps.get(side) + 1;
        if (last >= all_depths - 1)
            return false;
        added.push_back(std::uint16_t(last));
    }
    values.clear();
    std::set_union(before.begin(), before.end(), added.begin(), added.end(),
                   std::back_inserter(values));
    return values.size() == before.size() + count;
}

bool RankTables::to_ranks(DepthView depth, const Values& values, MutableDepthView ranks) {
    if (forward_values_ != values || forward_.empty()) {
        forward_values_ = values;
        make_ranks(values, forward_);
    }
    const std::uint16_t* table = forward_.data();
    int unknown = 0;
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* from = depth.row(y);
        std::uint16_t* to = ranks.row(y);
        for (int x = 0; x < depth.size.width; ++x)
            to[x] = table[from[x]];
        std::int16_t row_unknown = 0;
        for (int x = 0; x < depth.size.width; ++x)
            row_unknown = std::int16_t(row_unknown | -(to[x] == no_rank));
        unknown |= row_unknown;
    }
    return unknown == 0;
}

void RankTables::from_ranks(const Values& values, MutableDepthView depth) {
    if (backward_values_ != values || backward_.empty()) {
        backward_values_ = values;
        backward_.assign(all_depths, 0);
        std::copy(values.begin(), values.end(), backward_.begin() + first_rank);
        backward_[all_depths - 1] = 65535;
    }
    const std::uint16_t* table = backward_.data();
    for (int y = 0; y < depth.size.height; ++y) {
        std::uint16_t* row = depth.row(y);
        for (int x = 0; x < depth.size.width; ++x)
            row[x] = table[row[x]];
    }
}

void move_ranks(const Values& before, const Values& values, const std::uint16_t* from,
                std::size_t count, std::uint16_t* to) {
    // Each new value moves all ranks from its place on by one.
    std::vector<std::uint16_t> bounds;
    std::size_t known = 0;
    for (const std::uint16_t v : values) {
        if (known < before.size() && before[known] == v)
            ++known;
        else
            bounds.push_back(std::uint16_t(first_rank + known));
    }
    constexpr std::size_t few = 24;
    if (bounds.size() <= few) {
        shift_ranks(from, count, bounds.data(), bounds.size(), to);
        return;
    }
    std::vector<std::uint16_t> table(all_depths);
    for (std::size_t rank = 0, reached = 0; rank < all_depths; ++rank) {
        while (reached < bounds.size() && bounds[reached] <= rank)
            ++reached;
        table[rank] = std::uint16_t(rank + reached);
    }
    for (std::size_t i = 0; i < count; ++i)
        to[i] = table[from[i]];
}

}  // namespace theatron::codec::strata
