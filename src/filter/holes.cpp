// SPDX-License-Identifier: Apache-2.0
#include "filter/holes.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "filter/set_bits.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/holes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// A single lane has too few mask bits for whole bytes: the scalar build uses the reference.
void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch&) {
    fill_holes_reference(depth, rule);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Words = std::uint64_t*;
constexpr hn::ScalableTag<std::uint64_t> dw;
constexpr hn::ScalableTag<std::uint16_t> d;

// Pixels to fill are scattered, so vectors are gathered from groups of eight pixels.
#if HWY_HAVE_SCALABLE
constexpr hn::CappedTag<std::uint16_t, 8> dg;
#else
constexpr hn::CappedTag<std::uint16_t, 32> dg;
#endif
constexpr std::size_t groups_per_vector = hn::MaxLanes(dg) / 8;

// The bits from row 0 on, margin included, as bytes.
std::uint8_t* bytes_of(const HoleScratch& s, HoleScratch::Bits& bits) {
    return reinterpret_cast<std::uint8_t*>(bits.data() + HoleScratch::slack +
                                           HoleScratch::margin_rows * s.words_per_row());
}
// The pixel that belongs to the first of these bits.
std::uint16_t* pixels_of(DepthPlane& depth) {
    return depth.row(0) - DepthPlane::margin;
}
const std::uint16_t* pixels_of(const DepthPlane& depth) {
    return depth.row(0) - DepthPlane::margin;
}

// A range of whole rows of bits, margins included, in words.
struct Range {
    std::ptrdiff_t begin, end;
};

// Calls each(i) for all vectors of words in the range, upwards or downwards. The last vector
// may exceed the range.
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

// The words at i with all pixels moved left by `bits`, or right.
HWY_INLINE auto from_right(const std::uint64_t* words, std::ptrdiff_t i, int bits) {
    return hn::Or(hn::ShiftRightSame(hn::LoadU(dw, words + i), bits),
                  hn::ShiftLeftSame(hn::LoadU(dw, words + i + 1), 64 - bits));
}
HWY_INLINE auto from_left(const std::uint64_t* words, std::ptrdiff_t i, int bits) {
    return hn::Or(hn::ShiftLeftSame(hn::LoadU(dw, words + i), bits),
                  hn::ShiftRightSame(hn::LoadU(dw, words + i - 1), 64 - bits));
}

// Morphological opening: keeps the pixels that a square of set pixels covers. Squares are
// found by their top left pixel; the window's size doubles in each pass.
HWY_NOINLINE void open_by_square(HoleScratch& s, Words bits, int side, Range image) {
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

// Marks the pixels that may be filled. False if there are none.
HWY_NOINLINE bool mark_fillable(const DepthPlane& depth, int side, HoleScratch& s, Range image) {
    const int lanes = int(hn::Lanes(d));
    const auto zero = hn::Zero(d);
    std::uint8_t* hole = bytes_of(s, s.hole);
    const std::uint16_t* pixels = pixels_of(depth);
    for (int y = 0; y < depth.size().height; ++y) {
        const std::ptrdiff_t row = y * depth.pitch() + DepthPlane::margin;
        for (std::ptrdiff_t i = row; i < row + depth.padded_width(); i += lanes) {
            const auto none = hn::Eq(hn::LoadU(d, pixels + i), zero);
            hn::StoreMaskBits(d, none, hole + i / 8);
        }
    }
    std::copy(s.hole.begin(), s.hole.end(), s.work.begin());
    open_by_square(s, s.work.data(), side, image);
    auto any = hn::Zero(dw);
    upwards(image, [&](auto i) HWY_ATTR {
        const auto hole = hn::LoadU(dw, s.hole.data() + i);
        const auto may = hn::AndNot(hn::LoadU(dw, s.work.data() + i), hole);
        any = hn::Or(any, may);
        hn::StoreU(may, dw, s.may_fill.data() + i);
        hn::StoreU(may, dw, s.open.data() + i);
        hn::StoreU(hn::Not(hole), dw, s.known.data() + i);
    });
    return !hn::AllTrue(dw, hn::Eq(any, hn::Zero(dw)));
}

using Pixels = hn::Vec<decltype(dg)>;

HWY_INLINE void sort_pair(Pixels& a, Pixels& b) {
    const auto low = hn::Min(a, b);
    b = hn::Max(a, b);
    a = low;
}

// Loads the pixels of one vector's groups; `pixels` may be offset to load neighbours.
template <class Tag>
HWY_INLINE hn::Vec<Tag> load_groups(Tag tag, const std::uint16_t* pixels,
                                    const HoleScratch::Group* groups) {
    if constexpr (hn::MaxLanes(tag) > 8) {
        const hn::Half<Tag> half;
        return hn::Combine(tag, load_groups(half, pixels, groups + hn::MaxLanes(half) / 8),
                           load_groups(half, pixels, groups));
    } else {
        return hn::LoadU(tag, pixels + 8 * std::size_t(*groups));
    }
}

// rim_of() for a vector of pixels.
class RimLanes {
public:
    HWY_INLINE RimLanes(const std::uint16_t* pixels, std::ptrdiff_t pitch,
                        const HoleScratch::Group* groups)
        : n0_(load_groups(dg, pixels - pitch - 1, groups)),
          n1_(load_groups(dg, pixels - pitch, groups)),
          n2_(load_groups(dg, pixels - pitch + 1, groups)),
          n3_(load_groups(dg, pixels - 1, groups)),
          n4_(load_groups(dg, pixels + 1, groups)),
          n5_(load_groups(dg, pixels + pitch - 1, groups)),
          n6_(load_groups(dg, pixels + pitch, groups)),
          n7_(load_groups(dg, pixels + pitch + 1, groups)) {
        furthest_ = hn::Max(hn::Max(hn::Max(n0_, n1_), hn::Max(n2_, n3_)),
                            hn::Max(hn::Max(n4_, n5_), hn::Max(n6_, n7_)));
        // Subtracting one turns "no measurement" into the largest number for sorting.
        const auto one = hn::Set(dg, 1);
        n0_ = hn::Sub(n0_, one);
        n1_ = hn::Sub(n1_, one);
        n2_ = hn::Sub(n2_, one);
        n3_ = hn::Sub(n3_, one);
        n4_ = hn::Sub(n4_, one);
        n5_ = hn::Sub(n5_, one);
        n6_ = hn::Sub(n6_, one);
        n7_ = hn::Sub(n7_, one);
    }

    // Masks pixels with an edge among their neighbours; false without neighbours.
    HWY_INLINE auto edge(Tolerance tolerance) const {
        return hn::Not(within(tolerance, hn::Min(hn::Min(hn::Min(n0_, n1_), hn::Min(n2_, n3_)),
                                                 hn::Min(hn::Min(n4_, n5_), hn::Min(n6_, n7_)))));
    }

    // The median, or 0 at an edge. Destroys the neighbours: call it last.
    HWY_INLINE Pixels median_off_edge(Tolerance tolerance) {
        // The optimal sorting network for eight inputs. The compiler removes the last
        // comparators' unused outputs.
        sort_pair(n0_, n2_), sort_pair(n1_, n3_), sort_pair(n4_, n6_), sort_pair(n5_, n7_);
        sort_pair(n0_, n4_), sort_pair(n1_, n5_), sort_pair(n2_, n6_), sort_pair(n3_, n7_);
        sort_pair(n0_, n1_), sort_pair(n2_, n3_), sort_pair(n4_, n5_), sort_pair(n6_, n7_);
        sort_pair(n2_, n4_), sort_pair(n3_, n5_);
        sort_pair(n1_, n4_), sort_pair(n3_, n6_);
        sort_pair(n1_, n2_), sort_pair(n3_, n4_), sort_pair(n5_, n6_);
        // The lower median is the second, third or fourth for more than 2, 4 or 6 neighbours: the
        // largest of those that count, because they are sorted.
        const auto no_neighbour = hn::Set(dg, 0xffff);
        const auto second = hn::IfThenZeroElse(hn::Eq(n2_, no_neighbour), n1_);
        const auto third = hn::IfThenZeroElse(hn::Eq(n4_, no_neighbour), n2_);
        const auto fourth = hn::IfThenZeroElse(hn::Eq(n6_, no_neighbour), n3_);
        const auto median = hn::Max(hn::Max(n0_, second), hn::Max(third, fourth));
        return hn::IfThenElseZero(within(tolerance, n0_), hn::Add(median, hn::Set(dg, 1)));
    }

private:
    HWY_INLINE hn::Mask<decltype(dg)> within(Tolerance tolerance, Pixels nearest_less_one) const {
        const auto nearest = hn::Add(nearest_less_one, hn::Set(dg, 1));
        const auto limit = hn::SaturatedAdd(hn::Set(dg, tolerance.constant),
                                            hn::MulHigh(nearest, hn::Set(dg, tolerance.slope)));
        return hn::Eq(hn::SaturatedSub(hn::Sub(furthest_, nearest), limit), hn::Zero(dg));
    }

    Pixels n0_, n1_, n2_, n3_, n4_, n5_, n6_, n7_;
    Pixels furthest_;
};

// Fills the last vector with the image's first group.
HWY_INLINE void end_list(HoleScratch::Groups& groups, HoleScratch::Group* next) {
    groups.count = std::size_t(next - groups.places.data());
    std::fill_n(next, groups_per_vector, HoleScratch::Group(DepthPlane::margin / 8));
}

// Lists the groups that contain a set bit. Branch-free inside a vector of bytes, because they
// follow no pattern. A table takes the place of Highway's Compress: without AVX-512 that has no
// instruction, and GCC copies its table to the stack for each vector.
HWY_NOINLINE void list_groups(HoleScratch& s, HoleScratch::Bits& bits, Range image,
                              HoleScratch::Groups& groups) {
    const hn::CappedTag<HoleScratch::Group, 8> dp;
    const hn::Rebind<std::uint8_t, decltype(dp)> d_places;
    const hn::CappedTag<std::uint8_t, 64> db;
    const std::size_t lanes = hn::Lanes(db);
    const std::uint8_t* bytes = bytes_of(s, bits);
    const std::size_t size = 8 * std::size_t(image.end - image.begin);
    HoleScratch::Group* next = groups.places.data();
    // Reads beyond the last row, where the margin has no set bits.
    for (std::size_t i = 0; i < size; i += lanes) {
        const auto listed = hn::Ne(hn::LoadU(db, bytes + i), hn::Zero(db));
        if (hn::AllFalse(db, listed))
            continue;
        std::uint8_t masks[8] = {};
        hn::StoreMaskBits(db, listed, masks);
        for (std::size_t eight = 0; 8 * eight < lanes; ++eight) {
            const auto first = hn::Set(dp, HoleScratch::Group(i + 8 * eight));
            const std::uint8_t* places = set_bits_of_byte[masks[eight]].places;
            for (std::size_t k = 0; k < 8; k += hn::Lanes(dp))
                hn::StoreU(hn::Add(first, hn::PromoteTo(dp, hn::LoadU(d_places, places + k))), dp,
                           next + k);
            next += set_bits_of_byte[masks[eight]].count;
        }
    }
    end_list(groups, next);
}

// Lists those of the listed groups that contain a set bit.
HWY_NOINLINE void keep_groups(const HoleScratch::Groups& listed, const std::uint8_t* bytes,
                              HoleScratch::Groups& kept) {
    const HoleScratch::Group* from = listed.places.data();
    HoleScratch::Group* next = kept.places.data();
    for (std::size_t i = 0; i < listed.count; ++i) {
        const HoleScratch::Group group = from[i];
        *next = group;
        next += bytes[group] != 0 ? 1 : 0;
    }
    end_list(kept, next);
}

// Two-bit numbers, one per pixel, as bit planes.
struct Count {
    hn::Vec<decltype(dw)> ones, twos;
};
HWY_INLINE Count sum(hn::Vec<decltype(dw)> a, hn::Vec<decltype(dw)> b, hn::Vec<decltype(dw)> c) {
    const auto either = hn::Xor(a, b);
    return {hn::Xor(either, c), hn::Or(hn::And(a, b), hn::And(either, c))};
}

// Counts known neighbours and selects the open pixels that have enough of them.
void find_candidates(HoleScratch& s, int min_neighbours, Range image) {
    const std::ptrdiff_t row = s.words_per_row();
    const std::uint64_t* known = s.known.data();
    const auto all = hn::Set(dw, ~std::uint64_t(0));
    const auto bit_of_least = [&](int bit) HWY_ATTR {
        return (min_neighbours >> bit & 1) != 0 ? all : hn::Zero(dw);
    };
    const auto least1 = bit_of_least(0), least2 = bit_of_least(1), least4 = bit_of_least(2),
               least8 = bit_of_least(3);
    upwards(image, [&](auto i) HWY_ATTR {
        const auto open = hn::LoadU(dw, s.open.data() + i);
        if (hn::AllTrue(dw, hn::Eq(open, hn::Zero(dw)))) {
            hn::StoreU(open, dw, s.candidate.data() + i);
            return;
        }
        const auto in_row = [&](std::ptrdiff_t at) HWY_ATTR {
            return sum(from_left(known, at, 1), hn::LoadU(dw, known + at),
                       from_right(known, at, 1));
        };
        const Count above = in_row(i - row), below = in_row(i + row);
        const Count beside = sum(from_left(known, i, 1), hn::Zero(dw), from_right(known, i, 1));
        const Count ones = sum(above.ones, beside.ones, below.ones);
        const Count twos = sum(above.twos, beside.twos, below.twos);
        const auto bit1 = ones.ones;
        const auto bit2 = hn::Xor(twos.ones, ones.twos);
        const auto carry = hn::And(twos.ones, ones.twos);
        const auto bit4 = hn::Xor(twos.twos, carry);
        const auto bit8 = hn::And(twos.twos, carry);

        // From the lowest bit on: true if the count is at least the minimum so far.
        auto enough = hn::Or(bit1, hn::Not(least1));
        const auto next = [&](auto bit, auto least) HWY_ATTR {
            enough = hn::Or(hn::AndNot(least, bit), hn::And(hn::Not(hn::Xor(bit, least)), enough));
        };
        next(bit2, least2);
        next(bit4, least4);
        next(bit8, least8);
        hn::StoreU(hn::And(open, enough), dw, s.candidate.data() + i);
        hn::StoreU(hn::AndNot(enough, open), dw, s.open.data() + i);
    });
}

// Fills one ring of pixels, the candidates. Pixels at an edge are skipped for good: an edge
// remains one when more neighbours become known. False if nothing was filled.
bool fill_ring(DepthPlane& depth, Tolerance tolerance, HoleScratch& s) {
    std::uint16_t* const pixels = pixels_of(depth);
    const std::ptrdiff_t pitch = depth.pitch();
    const HoleScratch::Group* const groups = s.some.places.data();
    const std::size_t count = s.some.count;
    std::uint16_t* const medians = s.depth.data();
    std::uint8_t* const has_median = s.filled.data();
    for (std::size_t i = 0; i < count; i += groups_per_vector) {
        RimLanes rim(pixels, pitch, groups + i);
        const auto median = rim.median_off_edge(tolerance);
        hn::StoreU(median, dg, medians + 8 * i);
        hn::StoreMaskBits(dg, hn::Ne(median, hn::Zero(dg)), has_median + i);
    }
    std::uint8_t* const known = bytes_of(s, s.known);
    const std::uint8_t* const wanted = bytes_of(s, s.candidate);
    const hn::CappedTag<std::uint16_t, 8> eight;
    unsigned any = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const HoleScratch::Group group = groups[i];
        const std::uint8_t filled = has_median[i] & wanted[group];
        // Candidates are 0 until now, so bits are added to them.
        std::uint16_t* const pixel = pixels + 8 * std::size_t(group);
        const auto added =
            hn::IfThenElseZero(hn::LoadMaskBits(eight, &filled), hn::LoadU(eight, medians + 8 * i));
        hn::StoreU(hn::Or(hn::LoadU(eight, pixel), added), eight, pixel);
        known[group] |= filled;
        any |= filled;
    }
    return any != 0;
}

// Marks the fillable pixels that have an edge among their neighbours. False if there are none.
HWY_NOINLINE bool mark_edges(const DepthPlane& depth, Tolerance tolerance, HoleScratch& s) {
    const std::uint16_t* const pixels = pixels_of(depth);
    const std::ptrdiff_t pitch = depth.pitch();
    const HoleScratch::Group* const groups = s.all.places.data();
    const std::size_t count = s.all.count;
    std::uint8_t* const at_edge = s.filled.data();
    for (std::size_t i = 0; i < count; i += groups_per_vector) {
        const RimLanes rim(pixels, pitch, groups + i);
        hn::StoreMaskBits(dg, rim.edge(tolerance), at_edge + i);
    }
    std::uint8_t* const edges = bytes_of(s, s.edge);
    const std::uint8_t* const may_fill = bytes_of(s, s.may_fill);
    std::fill(s.edge.begin(), s.edge.end(), 0);
    unsigned any = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const HoleScratch::Group group = groups[i];
        const std::uint8_t marked = at_edge[i] & may_fill[group];
        edges[group] = marked;
        any |= marked;
    }
    return any != 0;
}

// Spreads the edge marks by one pixel, within the fillable pixels.
HWY_NOINLINE void spread_edges(HoleScratch& s, Range image) {
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
    list_groups(s, s.may_fill, image, s.all);
    for (int i = 0; i < rule.iterations; ++i) {
        find_candidates(s, rule.min_neighbours, image);
        keep_groups(s.all, bytes_of(s, s.candidate), s.some);
        if (!fill_ring(depth, rule.tolerance, s))
            break;
    }

    if (!mark_edges(depth, rule.tolerance, s))
        return;
    for (int i = 0; i < rule.iterations; ++i)
        spread_edges(s, image);
    const std::uint8_t* edges = bytes_of(s, s.edge);
    std::uint16_t* pixels = pixels_of(depth);
    const hn::CappedTag<std::uint16_t, 8> eight;
    keep_groups(s.all, edges, s.some);
    for (std::size_t i = 0; i < s.some.count; ++i) {
        const HoleScratch::Group group = s.some.places[i];
        std::uint16_t* const pixel = pixels + 8 * std::size_t(group);
        const auto near_edge = hn::LoadMaskBits(eight, edges + group);
        hn::StoreU(hn::IfThenZeroElse(near_edge, hn::LoadU(eight, pixel)), eight, pixel);
    }
}

#endif  // HWY_TARGET

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(fill_holes);

HoleScratch::HoleScratch(Size size) : words_per_row_(DepthPlane::pitch_of(size) / 64) {
    const std::size_t words =
        std::size_t(words_per_row_) * std::size_t(size.height + 2 * margin_rows) + 2 * slack;
    hole.assign(words, ~std::uint64_t(0));
    for (Bits* bits : {&may_fill, &open, &known, &candidate, &edge, &work})
        bits->assign(words, 0);
    // Slack, because whole vectors are written.
    constexpr std::size_t more = 16;
    const std::size_t most_groups =
        std::size_t(8 * words_per_row_) * std::size_t(size.height) + more;
    for (Groups* groups : {&all, &some})
        groups->places.resize(most_groups);
    depth.resize(8 * most_groups);
    filled.resize(most_groups);
}

void fill_holes(DepthPlane& depth, const HoleRule& rule, HoleScratch& scratch) {
    assert(rule.max_size >= 1 && rule.max_size < HoleScratch::margin_rows);
    HWY_DYNAMIC_DISPATCH(fill_holes)(depth, rule, scratch);
}

}  // namespace theatron::filter
#endif
