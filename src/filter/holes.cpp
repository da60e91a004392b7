// SPDX-License-Identifier: Apache-2.0
#include "filter/holes.h"

#include <algorithm>
#include <cassert>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/holes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// Bits come by the byte: one lane is too few.
void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch&) {
    fill_holes_reference(depth, rule);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Words = std::uint64_t*;
constexpr hn::ScalableTag<std::uint64_t> dw;
constexpr hn::ScalableTag<std::uint16_t> d;

std::uint8_t* bytes_of(Words words) {
    return reinterpret_cast<std::uint8_t*>(words);
}

// A range of whole rows of bits, margins included.
struct Range {
    std::ptrdiff_t begin, end;
};

// Calls each(i) for vectors of words of the range, upwards or downwards. The last
// vector may reach beyond the range.
template <class Each>
HWY_INLINE void upwards(Range range, Each each) {
    for (std::ptrdiff_t i = range.begin; i < range.end; i += std::ptrdiff_t(hn::Lanes(dw)))
        each(i);
}
template <class Each>
HWY_INLINE void downwards(Range range, Each each) {
    const std::ptrdiff_t lanes = hn::Lanes(dw);
    const std::ptrdiff_t vectors = (range.end - range.begin + lanes - 1) / lanes;
    for (std::ptrdiff_t i = range.begin + (vectors - 1) * lanes; i >= range.begin; i -= lanes)
        each(i);
}

// The words at i, seen `bits` pixels further right, or left.
HWY_INLINE auto from_right(const std::uint64_t* words, std::ptrdiff_t i, int bits) {
    return hn::Or(hn::ShiftRightSame(hn::LoadU(dw, words + i), bits),
                  hn::ShiftLeftSame(hn::LoadU(dw, words + i + 1), 64 - bits));
}
HWY_INLINE auto from_left(const std::uint64_t* words, std::ptrdiff_t i, int bits) {
    return hn::Or(hn::ShiftLeftSame(hn::LoadU(dw, words + i), bits),
                  hn::ShiftRightSame(hn::LoadU(dw, words + i - 1), 64 - bits));
}

// Leaves the pixels that a square of set pixels covers. The square is looked for
// by its top left pixel, with a window that doubles.
void open_by_square(HoleScratch& s, Words bits, int side, Range image) {
    const std::ptrdiff_t row = s.words_per_row();
    const std::ptrdiff_t above = row * (HoleScratch::margin_rows - 1);
    const Range extended{image.begin - above, image.end};
    for (int window = 1; window < side;) {
        const int step = std::min(window, side - window);
        upwards(extended, [&](auto i) {
            hn::StoreU(hn::And(hn::LoadU(dw, bits + i), from_right(bits, i, step)), dw, bits + i);
        });
        upwards(extended, [&](auto i) {
            hn::StoreU(hn::And(hn::LoadU(dw, bits + i), hn::LoadU(dw, bits + i + step * row)), dw,
                       bits + i);
        });
        window += step;
    }
    for (int window = 1; window < side;) {
        const int step = std::min(window, side - window);
        downwards(extended, [&](auto i) {
            hn::StoreU(hn::Or(hn::LoadU(dw, bits + i), from_left(bits, i, step)), dw, bits + i);
        });
        downwards({extended.begin + step * row, extended.end}, [&](auto i) {
            hn::StoreU(hn::Or(hn::LoadU(dw, bits + i), hn::LoadU(dw, bits + i - step * row)), dw,
                       bits + i);
        });
        window += step;
    }
}

// Finds what may be filled. False if nothing.
bool mark_fillable(const DepthPlane& depth, int side, HoleScratch& s, Range image) {
    const int lanes = int(hn::Lanes(d));
    const auto zero = hn::Zero(d);
    for (int y = 0; y < depth.size().height; ++y) {
        const std::uint16_t* row = depth.row(y);
        std::uint8_t* bytes = bytes_of(s.row(s.hole, y));
        for (int x = 0; x < depth.padded_width(); x += lanes)
            hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, row + x), zero), bytes + x / 8);
    }
    std::copy(s.hole.begin(), s.hole.end(), s.work.begin());
    open_by_square(s, s.work.data(), side, image);
    auto any = hn::Zero(dw);
    upwards(image, [&](auto i) {
        const auto may =
            hn::AndNot(hn::LoadU(dw, s.work.data() + i), hn::LoadU(dw, s.hole.data() + i));
        any = hn::Or(any, may);
        hn::StoreU(may, dw, s.may_fill.data() + i);
    });
    return !hn::AllTrue(dw, hn::Eq(any, hn::Zero(dw)));
}

// rim_of() for a vector of pixels.
struct RimLanes {
    hn::Vec<decltype(d)> count, median;
    hn::Mask<decltype(d)> edge;
};

template <class V>
HWY_INLINE void sort_pair(V& a, V& b) {
    const V low = hn::Min(a, b);
    b = hn::Max(a, b);
    a = low;
}

HWY_INLINE RimLanes rim_of_lanes(const std::uint16_t* pixel, std::ptrdiff_t pitch,
                                 Tolerance tolerance) {
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1);
    auto n0 = hn::LoadU(d, pixel - pitch - 1), n1 = hn::LoadU(d, pixel - pitch),
         n2 = hn::LoadU(d, pixel - pitch + 1), n3 = hn::LoadU(d, pixel - 1),
         n4 = hn::LoadU(d, pixel + 1), n5 = hn::LoadU(d, pixel + pitch - 1),
         n6 = hn::LoadU(d, pixel + pitch), n7 = hn::LoadU(d, pixel + pitch + 1);
    const auto furthest = hn::Max(hn::Max(hn::Max(n0, n1), hn::Max(n2, n3)),
                                  hn::Max(hn::Max(n4, n5), hn::Max(n6, n7)));
    // A mask is -1 in each lane.
    const auto is_none = [&](auto n) HWY_ATTR { return hn::VecFromMask(d, hn::Eq(n, zero)); };
    const auto minus_nones =
        hn::Add(hn::Add(hn::Add(is_none(n0), is_none(n1)), hn::Add(is_none(n2), is_none(n3))),
                hn::Add(hn::Add(is_none(n4), is_none(n5)), hn::Add(is_none(n6), is_none(n7))));
    const auto count = hn::Add(hn::Set(d, 8), minus_nones);

    // One less puts "no measurement" behind all others.
    n0 = hn::Sub(n0, one);
    n1 = hn::Sub(n1, one);
    n2 = hn::Sub(n2, one);
    n3 = hn::Sub(n3, one);
    n4 = hn::Sub(n4, one);
    n5 = hn::Sub(n5, one);
    n6 = hn::Sub(n6, one);
    n7 = hn::Sub(n7, one);
    // The best network for eight; of its result only the first four are used.
    sort_pair(n0, n2), sort_pair(n1, n3), sort_pair(n4, n6), sort_pair(n5, n7);
    sort_pair(n0, n4), sort_pair(n1, n5), sort_pair(n2, n6), sort_pair(n3, n7);
    sort_pair(n0, n1), sort_pair(n2, n3), sort_pair(n4, n5), sort_pair(n6, n7);
    sort_pair(n2, n4), sort_pair(n3, n5);
    sort_pair(n1, n4), sort_pair(n3, n6);
    sort_pair(n1, n2), sort_pair(n3, n4), sort_pair(n5, n6);

    auto median = n0;
    median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 2)), n1, median);
    median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 4)), n2, median);
    median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 6)), n3, median);
    const auto nearest = hn::Add(n0, one);
    const auto limit = hn::SaturatedAdd(hn::Set(d, tolerance.constant),
                                        hn::MulHigh(nearest, hn::Set(d, tolerance.slope)));
    return {count, hn::Add(median, one), hn::Gt(hn::Sub(furthest, nearest), limit)};
}

void list_blocks(const DepthPlane& depth, HoleScratch& s) {
    const int lanes = int(hn::Lanes(d));
    s.blocks.clear();
    for (int y = 0; y < depth.size().height; ++y) {
        const std::uint64_t* row = s.row(s.may_fill, y);
        for (int word = 0; 64 * word < depth.padded_width(); ++word) {
            if (row[word] == 0)
                continue;
            const std::uint64_t first = lanes == 64 ? ~0ull : (1ull << lanes) - 1;
            for (int x = 0; x < 64; x += lanes)
                if (row[word] >> x & first)
                    s.blocks.push_back({std::uint16_t(y), std::uint16_t(64 * word + x)});
        }
    }
}

// Fills one ring. Blocks that are full leave the list.
void fill_ring(DepthPlane& depth, const HoleRule& rule, HoleScratch& s) {
    const int lanes = int(hn::Lanes(d));
    const auto min_neighbours = hn::Set(d, std::uint16_t(rule.min_neighbours));
    std::uint16_t* pending = s.pending.data();
    for (const HoleScratch::Block block : s.open) {
        const std::uint16_t* pixel = depth.row(block.y) + block.x;
        std::uint8_t* left = bytes_of(s.row(s.left, block.y)) + block.x / 8;
        const auto wanted = hn::LoadMaskBits(d, left);
        const RimLanes rim = rim_of_lanes(pixel, depth.pitch(), rule.tolerance);
        const auto fills =
            hn::And(wanted, hn::AndNot(rim.edge, at_least(rim.count, min_neighbours)));
        hn::StoreU(hn::IfThenElse(fills, rim.median, hn::LoadU(d, pixel)), d, pending);
        pending += lanes;
        hn::StoreMaskBits(d, hn::AndNot(fills, wanted), left);
    }
    pending = s.pending.data();
    auto still_open = s.open.begin();
    for (const HoleScratch::Block block : s.open) {
        hn::StoreU(hn::LoadU(d, pending), d, depth.row(block.y) + block.x);
        pending += lanes;
        const std::uint8_t* left = bytes_of(s.row(s.left, block.y)) + block.x / 8;
        bool full = true;
        for (int byte = 0; byte < lanes / 8; ++byte)
            full &= left[byte] == 0;
        if (!full)
            *still_open++ = block;
    }
    s.open.erase(still_open, s.open.end());
}

// Marks what sees an edge. False if nothing does.
bool mark_edges(const DepthPlane& depth, Tolerance tolerance, HoleScratch& s) {
    bool any = false;
    for (const HoleScratch::Block block : s.blocks) {
        const RimLanes rim = rim_of_lanes(depth.row(block.y) + block.x, depth.pitch(), tolerance);
        const auto may_fill =
            hn::LoadMaskBits(d, bytes_of(s.row(s.may_fill, block.y)) + block.x / 8);
        // Without neighbours there are neither near nor far ones.
        const auto edge = hn::And(hn::And(rim.edge, may_fill), hn::Ne(rim.count, hn::Zero(d)));
        any |= !hn::AllFalse(d, edge);
        hn::StoreMaskBits(d, edge, bytes_of(s.row(s.edge, block.y)) + block.x / 8);
    }
    return any;
}

// One step from the edge through what may be filled.
void spread_edges(HoleScratch& s, Range image) {
    const std::uint64_t* edge = s.edge.data();
    const std::uint64_t* may_fill = s.may_fill.data();
    std::uint64_t* sideways = s.work.data();
    upwards(image, [&](auto i) {
        const auto words = hn::LoadU(dw, edge + i);
        hn::StoreU(hn::Or(words, hn::Or(from_left(edge, i, 1), from_right(edge, i, 1))), dw,
                   sideways + i);
    });
    const std::ptrdiff_t row = s.words_per_row();
    std::fill_n(sideways + image.begin - row, row, 0);
    std::fill_n(sideways + image.end, row, 0);
    upwards(image, [&](auto i) {
        const auto spread =
            hn::Or(hn::LoadU(dw, sideways + i),
                   hn::Or(hn::LoadU(dw, sideways + i - row), hn::LoadU(dw, sideways + i + row)));
        hn::StoreU(hn::And(spread, hn::LoadU(dw, may_fill + i)), dw, s.edge.data() + i);
    });
}

void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& s) {
    const std::ptrdiff_t row = s.words_per_row();
    const std::ptrdiff_t first = HoleScratch::slack + HoleScratch::margin_rows * row;
    const Range image{first, first + depth.size().height * row};
    if (!mark_fillable(depth, rule.max_size + 1, s, image))
        return;
    std::copy(s.may_fill.begin(), s.may_fill.end(), s.left.begin());
    list_blocks(depth, s);
    s.open = s.blocks;
    for (int i = 0; i < rule.iterations && !s.open.empty(); ++i)
        fill_ring(depth, rule, s);

    std::fill(s.edge.begin(), s.edge.end(), 0);
    if (!mark_edges(depth, rule.tolerance, s))
        return;
    for (int i = 0; i < rule.iterations; ++i)
        spread_edges(s, image);
    for (const HoleScratch::Block block : s.blocks) {
        std::uint16_t* pixel = depth.row(block.y) + block.x;
        const auto edge = hn::LoadMaskBits(d, bytes_of(s.row(s.edge, block.y)) + block.x / 8);
        hn::StoreU(hn::IfThenZeroElse(edge, hn::LoadU(d, pixel)), d, pixel);
    }
}

#endif  // HWY_TARGET

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(fill_holes);

HoleScratch::HoleScratch(Size size) : words_per_row_((size.width + 63) / 64 + 2) {
    const std::size_t words =
        std::size_t(words_per_row_) * std::size_t(size.height + 2 * margin_rows) + 2 * slack;
    hole.assign(words, ~std::uint64_t(0));
    for (Bits* bits : {&may_fill, &left, &edge, &work})
        bits->assign(words, 0);
    // The shortest vectors have eight pixels.
    const std::size_t most_blocks = std::size_t((size.width + 7) / 8) * std::size_t(size.height);
    blocks.reserve(most_blocks);
    open.reserve(most_blocks);
    // The longest have DepthPlane::margin.
    pending.resize(std::size_t(size.width + DepthPlane::margin) * std::size_t(size.height));
}

void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& scratch) {
    assert(rule.max_size >= 1 && rule.max_size < HoleScratch::margin_rows);
    HWY_DYNAMIC_DISPATCH(fill_holes)(depth, rule, scratch);
}

}  // namespace theatron::filter
#endif
