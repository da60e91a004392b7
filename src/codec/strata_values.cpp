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

// The rank of each depth; no_rank for depths that are no value.
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
    // Estimated from a sample of the pixels: per pixel, ranks save the logarithm of the
    // distance to the next value; the tolerance would save that of its width.
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

void RankTables::use(const Values& values) {
    if (forward_values_ == values && !forward_.empty())
        return;
    forward_values_ = values;
    make_ranks(values, forward_);
}

bool RankTables::to_ranks(const Layout& layout, DepthView depth, Values& values,
                          std::uint16_t* pixels) {
    use(values);
    new_.depths.clear();
    new_.bands.clear();
    rows_to_ranks(layout, depth, nullptr, forward_.data(), pixels, new_);
    const std::vector<std::uint16_t>& added = new_.depths;
    if (added.empty())
        return true;
    forward_.clear();  // rows_to_ranks has marked entries in it
    if (values.size() + added.size() > max_values)
        return false;

    // Ranks of known values move up by the number of new values below them.
    const Values before = values;
    const auto middle = values.insert(values.end(), added.begin(), added.end());
    std::sort(middle, values.end());
    std::inplace_merge(values.begin(), middle, values.end());
    use(values);
    RankShift(before, values).apply(pixels, layout.coded_values(), pixels);
    rows_to_ranks(layout, depth, &new_.bands, forward_.data(), pixels, new_);
    return true;
}

const std::uint16_t* RankTables::depths_of(const Values& values) {
    if (backward_values_ != values || backward_.empty()) {
        backward_values_ = values;
        backward_.assign(all_depths, 0);
        std::copy(values.begin(), values.end(), backward_.begin() + first_rank);
        backward_[all_depths - 1] = 65535;
    }
    return backward_.data();
}

RankShift::RankShift(const Values& before, const Values& values) {
    // Each new value moves all ranks above it by one.
    std::size_t known = 0;
    for (const std::uint16_t v : values) {
        if (known < before.size() && before[known] == v)
            ++known;
        else
            bounds_.push_back(std::uint16_t(first_rank + known));
    }
    constexpr std::size_t few = 24;
    if (bounds_.size() <= few)
        return;
    table_.resize(all_depths);
    for (std::size_t rank = 0, reached = 0; rank < all_depths; ++rank) {
        while (reached < bounds_.size() && bounds_[reached] <= rank)
            ++reached;
        table_[rank] = std::uint16_t(rank + reached);
    }
}

void RankShift::apply(const std::uint16_t* from, std::size_t count, std::uint16_t* to) const {
    if (table_.empty()) {
        shift_ranks(from, count, bounds_.data(), bounds_.size(), to);
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        to[i] = table_[from[i]];
}

}  // namespace theatron::codec::strata
