// SPDX-License-Identifier: Apache-2.0
// Strata: conversion between rows and step order, and the sampled equations of the
// linear predictor. Included once per instruction set.

// No include guard: the namespace differs from one inclusion to the next.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "codec/strata_kernel.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::codec::strata::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int tile = 8;

#if HWY_TARGET != HWY_SCALAR
// Transposes 8 by 8 values: `load(i)` returns row i, `store(i, v)` takes column i.
template <class Load, class Store>
HWY_INLINE void transpose_tile(Load load, Store store) {
    const hn::Full128<std::uint16_t> d;
    const hn::Full128<std::uint32_t> d32;
    const hn::Full128<std::uint64_t> d64;
    using V = hn::Vec<decltype(d)>;
    V a[8], b[8];
    for (int i = 0; i < 8; ++i)
        a[i] = load(i);
    for (int i = 0; i < 4; ++i) {
        b[2 * i] = hn::InterleaveLower(d, a[2 * i], a[2 * i + 1]);
        b[2 * i + 1] = hn::InterleaveUpper(d, a[2 * i], a[2 * i + 1]);
    }
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            const auto low = hn::BitCast(d32, b[4 * i + j]),
                       high = hn::BitCast(d32, b[4 * i + 2 + j]);
            a[4 * i + 2 * j] = hn::BitCast(d, hn::InterleaveLower(d32, low, high));
            a[4 * i + 2 * j + 1] = hn::BitCast(d, hn::InterleaveUpper(d32, low, high));
        }
    }
    for (int i = 0; i < 4; ++i) {
        const auto low = hn::BitCast(d64, a[i]), high = hn::BitCast(d64, a[4 + i]);
        store(2 * i, hn::BitCast(d, hn::InterleaveLower(d64, low, high)));
        store(2 * i + 1, hn::BitCast(d, hn::InterleaveUpper(d64, low, high)));
    }
}

#endif

// Maps pixels through a table. `to` may be `from`. Four results are stored at once, since most
// processors finish one store in a cycle. The fence keeps compilers from assembling larger vectors
// out of single look-ups, which costs more instructions.
HWY_INLINE void look_up(const std::uint16_t* table, const std::uint16_t* from, int count,
                        std::uint16_t* to) {
    const auto four = [&](int i) HWY_ATTR {
        std::uint64_t all = 0;
        for (int k = 0; k < 4; ++k) {
            const int place = std::endian::native == std::endian::little ? k : 3 - k;
            all |= std::uint64_t(table[from[i + k]]) << 16 * place;
        }
        std::memcpy(to + i, &all, sizeof(all));
        std::atomic_signal_fence(std::memory_order_seq_cst);
    };
    int i = 0;
    for (; i + 4 <= count; i += 4)
        four(i);
    for (; i < count; ++i)
        to[i] = table[from[i]];
}

// Visits 8 rows from y on in skewed tiles of 8 by 8 pixels. on_tile(x, at): the first
// row of the tile starts at x, each next row 4 pixels further left; `at` is the index
// of its first step and lane. on_pixel(x, row, at): each pixel outside such tiles.
template <class OnTile, class OnPixel>
HWY_INLINE void for_band(const Layout& layout, int y, OnTile on_tile, OnPixel on_pixel) {
    const auto [width, height] = layout.size;
    constexpr int lag = skew * (tile - 1);
    const int rows = std::min(tile, height - y);
    const int lane = y % lane_count;
    int x = lag;
    if (rows == tile && HWY_TARGET != HWY_SCALAR) {
        for (; x + tile <= width; x += tile)
            on_tile(x, std::size_t(layout.step_of(x, y)) * lane_count + lane);
    }
    for (int row = 0; row < rows; ++row) {
        // Tiles cover [lag - skew * row, x - skew * row) of this row.
        const int from = x > lag ? lag - skew * row : width;
        const int to = x > lag ? x - skew * row : width;
        std::size_t at = std::size_t(layout.step_of(0, y + row)) * lane_count + lane + row;
        for (int i = 0; i < from; ++i, at += lane_count)
            on_pixel(i, row, at);
        at += std::size_t(to - from) * lane_count;
        for (int i = to; i < width; ++i, at += lane_count)
            on_pixel(i, row, at);
    }
}

// `rows` starts at row y.
HWY_INLINE void band_to_steps(const Layout& layout, DepthView rows, int y, std::uint16_t* pixels) {
    for_band(
        layout, y,
        [&]([[maybe_unused]] int x, [[maybe_unused]] std::size_t at) HWY_ATTR {
#if HWY_TARGET != HWY_SCALAR
            const hn::Full128<std::uint16_t> d;
            transpose_tile([&](int i) HWY_ATTR { return hn::LoadU(d, rows.row(i) + x - skew * i); },
                           [&](int i, auto v)
                               HWY_ATTR { hn::StoreU(v, d, pixels + at + i * lane_count); });
#endif
        },
        [&](int x, int row, std::size_t at) { pixels[at] = rows.row(row)[x]; });
}

// Writes 0 to all positions outside the image.
HWY_INLINE void clear_outside(const Layout& layout, std::uint16_t* pixels) {
    const int behind = row_front + layout.size.width;
    const int rows = layout.groups * lane_count;
    for (int y = 0; y < rows; ++y) {
        std::uint16_t* const at =
            pixels + std::size_t(layout.step_of(-row_front, y)) * lane_count + y % lane_count;
        const int first = y < layout.size.height ? behind : row_front;
        for (int i = 0; i < row_front; ++i)
            at[std::size_t(i) * lane_count] = 0;
        for (int i = first; i < layout.pitch; ++i)
            at[std::size_t(i) * lane_count] = 0;
    }
    for (int lane = 1; lane < lane_count; ++lane) {
        for (int t = 0; t < skew * lane; ++t)
            pixels[std::size_t(t) * lane_count + lane] = 0;
        for (int t = layout.groups * layout.pitch + skew * (lane - 1); t < layout.steps; ++t)
            pixels[std::size_t(t) * lane_count + lane - 1] = 0;
    }
}

void rows_to_steps(const Layout& layout, DepthView depth, std::uint16_t* pixels) {
    clear_outside(layout, pixels);
    for (int y = 0; y < layout.size.height; y += tile)
        band_to_steps(layout, {depth.row(y), depth.size, depth.stride}, y, pixels);
}

void rows_to_ranks(const Layout& layout, DepthView depth, const std::vector<int>* bands,
                   std::uint16_t* ranks, std::uint16_t* pixels, NewDepths& found) {
    constexpr std::uint16_t no_number = 0x6000;  // in no rank, but in no_rank, seen_before, 65535
    constexpr std::uint16_t seen_before = no_rank - 1;
    const int width = layout.size.width, height = layout.size.height;
    found.band.resize(std::size_t(width) * tile + hn::MaxLanes(D16()));
    std::uint16_t* const band = found.band.data();
    const auto turn = [&](int y) HWY_ATTR {
        const int rows = std::min(tile, height - y);
        for (int i = 0; i < rows; ++i)
            look_up(ranks, depth.row(y + i), width, band + i * width);
        band_to_steps(layout, {band, layout.size}, y, pixels);
        return rows * width;
    };
    if (bands != nullptr) {
        for (const int y : *bands)
            turn(y);
        return;
    }
    clear_outside(layout, pixels);
    const D16 d;
    std::fill(found.band.end() - std::ptrdiff_t(hn::MaxLanes(d)), found.band.end(), 0);
    for (int y = 0; y < height; y += tile) {
        const int count = turn(y);
        V16 bits = hn::Zero(d);
        for (int i = 0; i < count; i += part_lanes)
            bits = hn::Or(bits, hn::LoadU(d, band + i));
        bits = hn::And(bits, hn::Set(d, no_number));
        if (HWY_LIKELY(hn::AllTrue(d, hn::Eq(bits, hn::Zero(d)))))
            continue;
        found.bands.push_back(y);
        for (int i = 0; i < count; ++i) {
            const std::uint16_t without = depth.row(y + i / width)[i % width];
            if (ranks[without] == no_rank) {
                ranks[without] = seen_before;
                found.depths.push_back(without);
            }
        }
    }
}

void steps_to_rows(const Layout& layout, const std::uint16_t* pixels, const std::uint16_t* depths,
                   MutableDepthView out) {
    for (int y = 0; y < layout.size.height; y += tile) {
        for_band(
            layout, y,
            [&]([[maybe_unused]] int x, [[maybe_unused]] std::size_t at) HWY_ATTR {
#if HWY_TARGET != HWY_SCALAR
                const hn::Full128<std::uint16_t> d;
                transpose_tile([&](int i)
                                   HWY_ATTR { return hn::LoadU(d, pixels + at + i * lane_count); },
                               [&](int i, auto v)
                                   HWY_ATTR { hn::StoreU(v, d, out.row(y + i) + x - skew * i); });
#endif
            },
            [&](int x, int row, std::size_t at) { out.row(y + row)[x] = pixels[at]; });
        if (depths == nullptr)
            continue;
        for (int i = y; i < std::min(y + tile, layout.size.height); ++i)
            look_up(depths, out.row(i), layout.size.width, out.row(i));
    }
}

void sample_equations(const Model& model, const std::uint16_t* pixels, int limit,
                      Equations& equations) {
    // The lanes sampled have their upper neighbours in the same group.
    constexpr int first = 8, sampled = 16;
    const hn::CappedTag<float, sampled> d;
    const hn::Rebind<std::int32_t, decltype(d)> di;
    const hn::Rebind<std::uint16_t, decltype(d)> d16;
    const std::size_t n = hn::Lanes(d);
    const bool temporal = model.reference_depth != nullptr;
    // Key frames get more samples: they are rare, and ranks leave few usable pixels.
    const int stride = temporal ? 37 : 17;
    const int taps = temporal ? tap_count : intra_taps;
    alignas(64) float sums[equation_count][hn::MaxLanes(d)] = {};

    for (int t = 9; t + 9 < model.layout.steps; t += stride) {
        for (int part = 0; part < sampled; part += int(n)) {
            const int lane = first + part;
            const auto pixel = [&](int ago, int up) HWY_ATTR {
                const std::uint16_t* at = pixels + std::size_t(t - ago) * lane_count + lane - up;
                return hn::BitCast(
                    di, hn::PromoteTo(hn::RebindToUnsigned<decltype(di)>(), hn::LoadU(d16, at)));
            };
            const auto before = [&](int ago, int up) HWY_ATTR {
                const std::uint16_t* at = model.reference_depth +
                                          std::size_t(t - ago + plane_margin) * plane_stride +
                                          plane_origin + lane - up;
                return hn::BitCast(
                    di, hn::PromoteTo(hn::RebindToUnsigned<decltype(di)>(), hn::LoadU(d16, at)));
            };
            const auto target = pixel(0, 0), left = pixel(1, 0), above = pixel(4, 1);
            const auto mean = hn::ShiftRight<1>(hn::Add(hn::Add(left, above), hn::Set(di, 1)));
            hn::Vec<decltype(di)> tap[tap_count] = {left,        pixel(5, 1), pixel(3, 1),
                                                    pixel(2, 0), pixel(8, 2), pixel(2, 1)};
            auto usable = hn::Ne(target, hn::Zero(di));
            for (int i = 0; i < intra_taps; ++i)
                usable = hn::And(usable, hn::Ne(tap[i], hn::Zero(di)));
            usable = hn::And(usable, hn::Ne(above, hn::Zero(di)));
            if (hn::AllFalse(di, usable))
                continue;
            if (temporal) {
                tap[6] = before(0, 0);
                tap[7] = before(1, 0);
                tap[8] = before(4, 1);
                tap[9] = before(-1, 0);
                tap[10] = before(-4, -1);
            }
            auto most = hn::Zero(di);
            for (int i = 0; i < taps; ++i) {
                tap[i] = hn::Sub(tap[i], mean);
                most = hn::Max(most, hn::Abs(tap[i]));
            }
            const auto goal = hn::Sub(target, mean);
            usable = hn::And(usable, hn::Lt(hn::Max(most, hn::Abs(goal)), hn::Set(di, limit)));
            const auto spread = hn::ConvertTo(d, most);
            const auto weight = hn::IfThenElseZero(
                hn::RebindMask(d, usable),
                hn::Div(hn::Set(d, 1.0f), hn::MulAdd(hn::Mul(spread, spread), hn::Set(d, 1.0f / 16),
                                                     hn::Set(d, 1.0f))));
            hn::Vec<decltype(d)> value[tap_count + 1];
            for (int i = 0; i < taps; ++i)
                value[i] = hn::ConvertTo(d, tap[i]);
            value[taps] = hn::ConvertTo(d, goal);
            int at = 0;
            for (int i = 0; i < taps; ++i) {
                const auto weighted = hn::Mul(value[i], weight);
                for (int j = i; j <= taps; ++j, ++at)
                    hn::Store(hn::MulAdd(weighted, value[j], hn::Load(d, sums[at])), d, sums[at]);
            }
        }
    }
    for (int i = 0; i < equation_count; ++i) {
        equations[i] = 0;
        for (std::size_t lane = 0; lane < n; ++lane)
            equations[i] += double(sums[i][lane]);
    }
}

void shift_ranks(const std::uint16_t* from, std::size_t count, const std::uint16_t* bounds,
                 std::size_t bound_count, std::uint16_t* to) {
    const hn::CappedTag<std::uint16_t, 1> d1;
    const hn::ScalableTag<std::uint16_t> d;
    const auto shift = [&](auto tag, std::size_t at) HWY_ATTR {
        const auto rank = hn::LoadU(tag, from + at);
        auto moved = rank;
        for (std::size_t i = 0; i < bound_count; ++i) {
            const auto below = hn::Lt(rank, hn::Set(tag, bounds[i]));
            moved = hn::Add(moved, hn::IfThenZeroElse(below, hn::Set(tag, 1)));
        }
        hn::StoreU(moved, tag, to + at);
    };
    std::size_t at = 0;
    for (; at + hn::Lanes(d) <= count; at += hn::Lanes(d))
        shift(d, at);
    for (; at < count; ++at)
        shift(d1, at);
}

}  // namespace theatron::codec::strata::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
