// SPDX-License-Identifier: Apache-2.0
#include "filter/speckles.h"

#include <algorithm>
#include <bit>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/speckles.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {

// Finds the measured pixels of a row, and their links to the pixel at the left and above.
#if HWY_TARGET == HWY_SCALAR

void link_row(const DepthPlane& depth, int y, Tolerance tolerance, SpeckleScratch& s) {
    const auto set = [](std::vector<std::uint64_t>& bits, int x, bool value) {
        const std::uint64_t bit = std::uint64_t(1) << x % 64;
        std::uint64_t& word = bits[std::size_t(x) / 64];
        word = value ? word | bit : word & ~bit;
    };
    const std::uint16_t* row = depth.row(y);
    const std::uint16_t* above = depth.row(y - 1);
    for (int x = 0; x < depth.size().width; ++x) {
        set(s.measured, x, row[x] != none);
        set(s.to_left, x, hang_together(row[x], row[x - 1], tolerance));
        set(s.to_above, x, hang_together(row[x], above[x], tolerance));
    }
}

#else

void link_row(const DepthPlane& depth, int y, Tolerance tolerance, SpeckleScratch& s) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const auto zero = hn::Zero(d);
    const auto constant = hn::Set(d, tolerance.constant);
    const auto slope = hn::Set(d, tolerance.slope);
    auto* measured = reinterpret_cast<std::uint8_t*>(s.measured.data());
    auto* to_left = reinterpret_cast<std::uint8_t*>(s.to_left.data());
    auto* to_above = reinterpret_cast<std::uint8_t*>(s.to_above.data());
    const std::uint16_t* row = depth.row(y);
    const std::uint16_t* above = depth.row(y - 1);
    for (int x = 0; x < depth.padded_width(); x += lanes) {
        const auto center = hn::LoadU(d, row + x);
        const auto hangs_on = [&](const std::uint16_t* p) HWY_ATTR {
            const auto other = hn::LoadU(d, p);
            const auto nearer = hn::Min(center, other);
            const auto limit = hn::SaturatedAdd(constant, hn::MulHigh(nearer, slope));
            return hn::And(hn::Ne(nearer, zero),
                           at_most(hn::Sub(hn::Max(center, other), nearer), limit));
        };
        hn::StoreMaskBits(d, hn::Ne(center, zero), measured + x / 8);
        hn::StoreMaskBits(d, hangs_on(row + x - 1), to_left + x / 8);
        hn::StoreMaskBits(d, hangs_on(above + x), to_above + x / 8);
    }
}

#endif  // HWY_TARGET

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {
namespace {

HWY_EXPORT(link_row);

using Run = SpeckleScratch::Run;

// Splits the row into runs of linked pixels.
void add_runs(SpeckleScratch& s) {
    std::size_t open = s.runs.size();
    for (std::size_t word = 0; word + 1 < s.measured.size(); ++word) {
        // Beyond the end of the row there are no links.
        const std::uint64_t next = s.to_left[word] >> 1 | s.to_left[word + 1] << 63;
        const auto base = unsigned(64 * word);
        for (std::uint64_t starts = s.measured[word] & ~s.to_left[word]; starts != 0;
             starts &= starts - 1) {
            const auto self = std::uint32_t(s.runs.size());
            s.runs.push_back(
                {std::uint16_t(base + unsigned(std::countr_zero(starts))), 0, self, 0});
        }
        for (std::uint64_t ends = s.measured[word] & ~next; ends != 0; ends &= ends - 1) {
            Run& run = s.runs[open++];
            run.end = std::uint16_t(base + unsigned(std::countr_zero(ends)) + 1);
            run.pixels = unsigned(run.end - run.begin);
        }
    }
}

bool any_between(const std::vector<std::uint64_t>& bits, unsigned begin, unsigned end) {
    const unsigned first = begin / 64, last = (end - 1) / 64;
    const std::uint64_t from = ~std::uint64_t(0) << begin % 64;
    const std::uint64_t to = ~std::uint64_t(0) >> (63 - (end - 1) % 64);
    if (first == last)
        return (bits[first] & from & to) != 0;
    if ((bits[first] & from) != 0 || (bits[last] & to) != 0)
        return true;
    return std::any_of(bits.begin() + first + 1, bits.begin() + last,
                       [](std::uint64_t word) { return word != 0; });
}

std::uint32_t root_of(std::vector<Run>& runs, std::uint32_t run) {
    while (runs[run].root != run) {
        runs[run].root = runs[runs[run].root].root;
        run = runs[run].root;
    }
    return run;
}

// Merges the components of two runs. The root is the first run of the component.
void join(std::vector<Run>& runs, std::uint32_t a, std::uint32_t b) {
    a = root_of(runs, a);
    b = root_of(runs, b);
    if (a == b)
        return;
    if (b < a)
        std::swap(a, b);
    runs[b].root = a;
    runs[a].pixels += runs[b].pixels;
}

// Merges runs of a row with those above that they touch and are linked with.
void join_rows(SpeckleScratch& s, std::uint32_t above, std::uint32_t row, std::uint32_t end) {
    const std::uint32_t above_end = row;
    while (above < above_end && row < end) {
        const Run &a = s.runs[above], &b = s.runs[row];
        const unsigned begin = std::max(a.begin, b.begin), stop = std::min(a.end, b.end);
        const bool a_ends_first = a.end < b.end;
        if (begin < stop && any_between(s.to_above, begin, stop))
            join(s.runs, above, row);
        if (a_ends_first)
            ++above;
        else
            ++row;
    }
}

}  // namespace

SpeckleScratch::SpeckleScratch(Size size) {
    runs.reserve(size.area());
    const std::size_t words = std::size_t(size.width + 63) / 64 + 1;
    for (auto* bits : {&measured, &to_left, &to_above})
        bits->assign(words, 0);
    first_run.resize(std::size_t(size.height) + 1);
}

void remove_speckles(DepthPlane& depth, const SpeckleRule& rule, SpeckleScratch& s) {
    const auto link = HWY_DYNAMIC_DISPATCH(link_row);
    const int height = depth.size().height;
    s.runs.clear();
    std::uint32_t above = 0;
    for (int y = 0; y < height; ++y) {
        link(depth, y, rule.tolerance, s);
        const auto row = std::uint32_t(s.runs.size());
        s.first_run[std::size_t(y)] = row;
        add_runs(s);
        join_rows(s, above, row, std::uint32_t(s.runs.size()));
        above = row;
    }
    s.first_run[std::size_t(height)] = std::uint32_t(s.runs.size());

    for (int y = 0; y < height; ++y)
        for (std::uint32_t i = s.first_run[std::size_t(y)]; i < s.first_run[std::size_t(y) + 1];
             ++i) {
            const Run& run = s.runs[i];
            if (int(s.runs[root_of(s.runs, i)].pixels) <= rule.max_pixels)
                std::fill(depth.row(y) + run.begin, depth.row(y) + run.end, std::uint16_t(0));
        }
}

}  // namespace theatron::filter
#endif
