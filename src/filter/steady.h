// SPDX-License-Identifier: Apache-2.0
// Stills the flicker of sensors that have few distinct depths, as stereo cameras do, without
// new depths: each output is a measurement of its pixel.
//
// A pixel's output stays while measurements are within a tolerance of it. The tolerance grows
// with the squared distance, as the steps of a disparity do. The newest measurement is taken
// - at once if it is beyond the tolerance,
// - if measurements were on the same side of the output for several frames,
// - if most pixels of its block are on one side of their outputs: a surface that moves slowly,
//   or a camera that does. Pixels that followed one by one would tear it into a pattern.
// A pixel without measurement keeps its depth for a few frames.
//
// All numbers are 16-bit integers, so that all variants give equal results.
#pragma once

#include <cstddef>

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

// The image is divided into squares of this side, from its upper left corner.
inline constexpr int steady_block = 16;
inline constexpr int most_steady_frames = 100;

struct SteadyRule {
    int tolerance_constant = 1;     // in depth units, at most 0xffff
    int tolerance_squared = 34360;  // times depth^2 / 2^32, in depth units; at most 0xffff
    int frames = 8;                 // on one side, 1 to most_steady_frames
    int together = 80;              // percent of a block's pixels, 1 to 100
    int most_hold = 1;              // frames, at most 15
};

// The state of a pixel, packed into two numbers.
struct SteadyPixel {
    std::uint16_t depth = 0;  // the output
    // Frames on one side (7 bits); above them a bit, set if that side is the nearer one; frames
    // missing (high byte).
    std::uint16_t run = 0;
};

struct SteadyState {
    explicit SteadyState(Size size) : depth(size), run(size) {}
    void clear() {
        depth.clear();
        run.clear();
    }
    DepthPlane depth, run;
};

// Filters one frame; the result is the state's depth. `missed` is the number of frames that
// were missed before this one: it counts as if they had been like this one.
void apply_steady(const DepthPlane& in, const SteadyRule& rule, int missed, SteadyState& state);
void apply_steady_reference(const DepthPlane& in, const SteadyRule& rule, int missed,
                            SteadyState& state);

inline constexpr int steady_count_bits = 0x7f;
inline constexpr int steady_nearer_bit = 0x80;
inline constexpr int steady_one_missing = 0x100;

THEATRON_HD inline bool steady_tolerates(const SteadyRule& rule, int depth, int measured) {
    const int squared = int((std::uint32_t(depth) * std::uint32_t(depth)) >> 16);
    const int grown = int((std::uint32_t(squared) * std::uint32_t(rule.tolerance_squared)) >> 16);
    return distance(measured, depth) <= smaller(rule.tolerance_constant + grown, 0xffff);
}

// True if most pixels that are measured and tolerated are on one side of their outputs. The
// pointers are those of the block's upper left pixel.
THEATRON_HD inline bool steady_block_moves(const std::uint16_t* depth, std::ptrdiff_t depth_pitch,
                                           const std::uint16_t* measured,
                                           std::ptrdiff_t measured_pitch, int columns, int rows,
                                           const SteadyRule& rule) {
    int pixels = 0, side = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const int before = depth[y * depth_pitch + x], now = measured[y * measured_pitch + x];
            if (before == none || now == none || !steady_tolerates(rule, before, now))
                continue;
            ++pixels;
            side += (now > before) - (now < before);
        }
    return pixels > 0 && larger(side, -side) * 100 >= rule.together * pixels;
}

THEATRON_HD inline SteadyPixel steady_step(const SteadyPixel& before, int measured,
                                           const SteadyRule& rule, int missed, bool block_moves) {
    if (measured == none) {
        if (before.depth == none || before.run / steady_one_missing >= rule.most_hold)
            return {};
        return {before.depth, std::uint16_t(before.run + steady_one_missing)};
    }
    const SteadyPixel taken{std::uint16_t(measured), 0};
    if (block_moves || before.depth == none || !steady_tolerates(rule, before.depth, measured))
        return taken;
    if (measured == before.depth)
        return taken;
    const int side = measured < before.depth ? steady_nearer_bit : 0;
    const int count_before =
        (before.run & steady_nearer_bit) == side ? before.run & steady_count_bits : 0;
    const int count = count_before + 1 + smaller(missed, most_steady_frames);
    if (count >= rule.frames)
        return taken;
    return {before.depth, std::uint16_t(count | side)};
}

}  // namespace theatron::filter
