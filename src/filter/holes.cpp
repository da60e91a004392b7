// SPDX-License-Identifier: Apache-2.0
#include "filter/holes.h"

#include <algorithm>
#include <cassert>
#include <cstring>

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

using Pixels = hn::Vec<decltype(d)>;

HWY_INLINE void sort_pair(Pixels& a, Pixels& b) {
    const auto low = hn::Min(a, b);
    b = hn::Max(a, b);
    a = low;
}

// rim_of() for a vector of pixels, in two steps: what is found more often first.
class RimLanes {
public:
    HWY_INLINE RimLanes(const std::uint16_t* pixel, std::ptrdiff_t pitch)
        : n0_(hn::LoadU(d, pixel - pitch - 1)),
          n1_(hn::LoadU(d, pixel - pitch)),
          n2_(hn::LoadU(d, pixel - pitch + 1)),
          n3_(hn::LoadU(d, pixel - 1)),
          n4_(hn::LoadU(d, pixel + 1)),
          n5_(hn::LoadU(d, pixel + pitch - 1)),
          n6_(hn::LoadU(d, pixel + pitch)),
          n7_(hn::LoadU(d, pixel + pitch + 1)) {}

    // Without neighbours there are neither near nor far ones.
    HWY_INLINE auto edge(Tolerance tolerance) {
        const auto furthest = hn::Max(hn::Max(hn::Max(n0_, n1_), hn::Max(n2_, n3_)),
                                      hn::Max(hn::Max(n4_, n5_), hn::Max(n6_, n7_)));
        // One less puts "no measurement" behind all others.
        const auto one = hn::Set(d, 1);
        n0_ = hn::Sub(n0_, one);
        n1_ = hn::Sub(n1_, one);
        n2_ = hn::Sub(n2_, one);
        n3_ = hn::Sub(n3_, one);
        n4_ = hn::Sub(n4_, one);
        n5_ = hn::Sub(n5_, one);
        n6_ = hn::Sub(n6_, one);
        n7_ = hn::Sub(n7_, one);
        const auto nearest = hn::Add(hn::Min(hn::Min(hn::Min(n0_, n1_), hn::Min(n2_, n3_)),
                                             hn::Min(hn::Min(n4_, n5_), hn::Min(n6_, n7_))),
                                     one);
        const auto limit = hn::SaturatedAdd(hn::Set(d, tolerance.constant),
                                            hn::MulHigh(nearest, hn::Set(d, tolerance.slope)));
        return hn::Gt(hn::Sub(furthest, nearest), limit);
    }

    // Behind edge().
    HWY_INLINE Pixels count() const {
        const auto nothing = hn::Set(d, 0xffff);
        // A mask is -1 in each lane.
        const auto is_none = [&](Pixels n)
                                 HWY_ATTR { return hn::VecFromMask(d, hn::Eq(n, nothing)); };
        return hn::Add(
            hn::Set(d, 8),
            hn::Add(
                hn::Add(hn::Add(is_none(n0_), is_none(n1_)), hn::Add(is_none(n2_), is_none(n3_))),
                hn::Add(hn::Add(is_none(n4_), is_none(n5_)), hn::Add(is_none(n6_), is_none(n7_)))));
    }

    // Behind edge(), and once.
    HWY_INLINE Pixels median(Pixels count) {
        // The best network for eight; of its result only the first four are used.
        sort_pair(n0_, n2_), sort_pair(n1_, n3_), sort_pair(n4_, n6_), sort_pair(n5_, n7_);
        sort_pair(n0_, n4_), sort_pair(n1_, n5_), sort_pair(n2_, n6_), sort_pair(n3_, n7_);
        sort_pair(n0_, n1_), sort_pair(n2_, n3_), sort_pair(n4_, n5_), sort_pair(n6_, n7_);
        sort_pair(n2_, n4_), sort_pair(n3_, n5_);
        sort_pair(n1_, n4_), sort_pair(n3_, n6_);
        sort_pair(n1_, n2_), sort_pair(n3_, n4_);
        auto median = n0_;
        median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 2)), n1_, median);
        median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 4)), n2_, median);
        median = hn::IfThenElse(hn::Gt(count, hn::Set(d, 6)), n3_, median);
        return hn::Add(median, hn::Set(d, 1));
    }

private:
    Pixels n0_, n1_, n2_, n3_, n4_, n5_, n6_, n7_;
};

void list_blocks(const DepthPlane& depth, HoleScratch& s) {
    const int lanes = int(hn::Lanes(d));
    const std::uint64_t first = (std::uint64_t(1) << lanes) - 1;
    s.blocks.clear();
    for (int y = 0; y < depth.size().height; ++y) {
        const std::uint64_t* row = s.row(s.may_fill, y);
        for (int word = 0; 64 * word < depth.padded_width(); ++word) {
            if (row[word] == 0)
                continue;
            for (int x = 0; x < 64; x += lanes)
                if ((row[word] >> x & first) != 0)
                    s.blocks.push_back({std::uint32_t(y * depth.pitch() + 64 * word + x),
                                        std::uint32_t(8 * (y * s.words_per_row() + word) + x / 8)});
        }
    }
}

// Whether an open pixel of the block lies beside one of the ring.
HWY_INLINE bool reaches_block(std::uint8_t* ring, const std::uint8_t* open,
                              std::ptrdiff_t bytes_per_row) {
    // From eight pixels left of the block on.
    const auto word_at = [](const std::uint8_t* bytes) {
        std::uint64_t word;
        std::memcpy(&word, bytes - 1, sizeof(word));
        return word;
    };
    const std::uint64_t rows =
        word_at(ring - bytes_per_row) | word_at(ring) | word_at(ring + bytes_per_row);
    constexpr std::uint64_t block = ((std::uint64_t(1) << hn::MaxLanes(d)) - 1) << 8;
    return ((rows | rows << 1 | rows >> 1) & word_at(open) & block) != 0;
}

// Fills one ring of pixels. After the first only what lies beside a pixel of the
// ring before can have changed. False if nothing was filled.
bool fill_ring(DepthPlane& depth, const HoleRule& rule, HoleScratch& s, bool first) {
    const int lanes = int(hn::Lanes(d));
    const auto min_neighbours = hn::Set(d, std::uint16_t(rule.min_neighbours));
    const std::ptrdiff_t bytes_per_row = 8 * s.words_per_row();
    std::uint16_t* pixels = depth.row(0);
    std::uint8_t* open = bytes_of(s.row(s.open, 0));
    std::uint8_t* ring = bytes_of(s.row(s.ring, 0));
    std::uint8_t* next_ring = bytes_of(s.row(s.next_ring, 0));
    std::uint16_t* pending = s.pending.data();
    s.changed.clear();
    std::fill(s.next_ring.begin(), s.next_ring.end(), 0);
    for (const HoleScratch::Block block : s.open_blocks) {
        if (!first && !reaches_block(ring + block.byte, open + block.byte, bytes_per_row))
            continue;
        std::uint16_t* pixel = pixels + block.pixel;
        const auto wanted = hn::LoadMaskBits(d, open + block.byte);
        RimLanes rim(pixel, depth.pitch());
        const auto edge = rim.edge(rule.tolerance);
        const auto count = rim.count();
        const auto fills = hn::And(wanted, hn::AndNot(edge, at_least(count, min_neighbours)));
        if (hn::AllFalse(d, fills))
            continue;
        hn::StoreMaskBits(d, fills, next_ring + block.byte);
        hn::StoreU(hn::IfThenElse(fills, rim.median(count), hn::LoadU(d, pixel)), d, pending);
        pending += lanes;
        s.changed.push_back(block);
    }
    pending = s.pending.data();
    for (const HoleScratch::Block block : s.changed) {
        hn::StoreU(hn::LoadU(d, pending), d, pixels + block.pixel);
        pending += lanes;
        const auto was_open = hn::LoadMaskBits(d, open + block.byte);
        const auto filled = hn::LoadMaskBits(d, next_ring + block.byte);
        hn::StoreMaskBits(d, hn::AndNot(filled, was_open), open + block.byte);
    }
    // Without branches: which blocks are full follows no pattern.
    std::size_t kept = 0;
    for (const HoleScratch::Block block : s.open_blocks) {
        const auto still_open = hn::LoadMaskBits(d, open + block.byte);
        s.open_blocks[kept] = block;
        kept += !hn::AllFalse(d, still_open);
    }
    s.open_blocks.resize(kept);
    std::swap(s.ring, s.next_ring);
    return !s.changed.empty();
}

// Marks what sees an edge. False if nothing does.
bool mark_edges(const DepthPlane& depth, Tolerance tolerance, HoleScratch& s) {
    const std::uint16_t* pixels = depth.row(0);
    const std::uint8_t* may_fill = bytes_of(s.row(s.may_fill, 0));
    std::uint8_t* edges = bytes_of(s.row(s.edge, 0));
    std::fill(s.edge.begin(), s.edge.end(), 0);
    bool any = false;
    for (const HoleScratch::Block block : s.blocks) {
        RimLanes rim(pixels + block.pixel, depth.pitch());
        const auto edge = hn::And(rim.edge(tolerance), hn::LoadMaskBits(d, may_fill + block.byte));
        any |= !hn::AllFalse(d, edge);
        hn::StoreMaskBits(d, edge, edges + block.byte);
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
    list_blocks(depth, s);
    std::copy(s.may_fill.begin(), s.may_fill.end(), s.open.begin());
    s.open_blocks = s.blocks;
    for (int i = 0; i < rule.iterations; ++i)
        if (!fill_ring(depth, rule, s, i == 0))
            break;

    if (!mark_edges(depth, rule.tolerance, s))
        return;
    for (int i = 0; i < rule.iterations; ++i)
        spread_edges(s, image);
    const std::uint8_t* edges = bytes_of(s.row(s.edge, 0));
    for (const HoleScratch::Block block : s.blocks) {
        std::uint16_t* pixel = depth.row(0) + block.pixel;
        const auto edge = hn::LoadMaskBits(d, edges + block.byte);
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
    for (Bits* bits : {&may_fill, &open, &ring, &next_ring, &edge, &work})
        bits->assign(words, 0);
    // The shortest vectors have eight pixels.
    const std::size_t most_blocks = std::size_t((size.width + 7) / 8) * std::size_t(size.height);
    blocks.reserve(most_blocks);
    open_blocks.reserve(most_blocks);
    changed.reserve(most_blocks);
    // The longest have DepthPlane::margin.
    pending.resize(std::size_t(size.width + DepthPlane::margin) * std::size_t(size.height));
}

void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& scratch) {
    assert(rule.max_size >= 1 && rule.max_size < HoleScratch::margin_rows);
    HWY_DYNAMIC_DISPATCH(fill_holes)(depth, rule, scratch);
}

}  // namespace theatron::filter
#endif
