// SPDX-License-Identifier: Apache-2.0
// Strata's model in its plainest form, pixel by pixel: the definition that the
// kernels must equal. For tests.
#pragma once

#include <cstdlib>
#include <vector>

#include "codec/strata_kernel.h"

namespace theatron::codec::strata {

// One image and the positions around it, in rows.
class ReferenceModel {
public:
    ReferenceModel(Size size, const Weights& weights, bool blend)
        : size_(size), weights_(weights), blend_(blend) {
        pixels_.assign(std::size_t(size.width + 4) * std::size_t(rows()), {});
    }

    struct Coded {
        std::uint16_t token = 0;  // context * token_count + token
        std::uint16_t extra = 0;
    };

    // Encodes a lossless image against `before`, which may be null.
    std::vector<Coded> encode(DepthView depth, const ReferenceModel* before) {
        std::vector<Coded> coded;
        for (int y = 0; y < rows(); ++y) {
            for (int x = -2; x < size_.width + 2; ++x) {
                const bool is_pixel = x >= 0 && x < size_.width && y < size_.height;
                step(x, y, before, is_pixel ? &depth.row(y)[x] : nullptr, coded);
            }
        }
        return coded;
    }

private:
    struct Pixel {
        std::uint16_t depth = 0;
        std::uint16_t valid = 0;
        int error[4] = {};
        int residual = 0;
    };

    // Rows of all groups; rows below the image repeat its last row.
    int rows() const { return (size_.height + lane_count - 1) / lane_count * lane_count; }

    // Everything around the rows is zero; the positions in front of and behind a row
    // belong to it. The row after the last group repeats the row above as well, but
    // only up to the position that lane 0 reaches while lane 31, 124 steps behind,
    // ends the image.
    const Pixel& at(int x, int y) const {
        static const Pixel none;
        if (y == rows() && x + row_front < skew * (lane_count - 1))
            y = rows() - 1;
        if (y < 0 || y >= rows() || x < -2 || x >= size_.width + 2)
            return none;
        return pixels_[std::size_t(y) * std::size_t(size_.width + 4) + std::size_t(x + 2)];
    }

    static std::uint16_t half(std::uint16_t v) { return std::uint16_t(std::int16_t(v) >> 1); }
    static int distance(std::uint16_t a, std::uint16_t b) {
        return std::abs(int(std::int16_t(a - b)));
    }

    std::uint16_t linear(int x, int y, const ReferenceModel* before, std::uint16_t mean) const {
        std::uint16_t taps[tap_count] = {at(x - 1, y).depth,     at(x - 1, y - 1).depth,
                                         at(x + 1, y - 1).depth, at(x - 2, y).depth,
                                         at(x, y - 2).depth,     at(x + 2, y - 1).depth};
        if (before != nullptr) {
            const Pixel* near[] = {&before->at(x, y), &before->at(x - 1, y), &before->at(x, y - 1),
                                   &before->at(x + 1, y), &before->at(x, y + 1)};
            for (int i = 0; i < 5; ++i)
                taps[intra_taps + i] = near[i]->depth;
        }
        std::uint16_t sum = 4;
        for (int i = 0; i < (before != nullptr ? tap_count : intra_taps); ++i) {
            const auto difference = std::int16_t((taps[i] - mean) * 8);
            sum = std::uint16_t(sum + ((difference * weights_[i] + (1 << 14)) >> 15));
        }
        return std::uint16_t(mean + (std::int16_t(sum) >> 3));
    }

    void step(int x, int y, const ReferenceModel* before, const std::uint16_t* pixel,
              std::vector<Coded>& coded) {
        const Pixel &left = at(x - 1, y), &above = at(x, y - 1);
        const Pixel &upper_left = at(x - 1, y - 1), &upper_right = at(x + 1, y - 1);
        Pixel& now = const_cast<Pixel&>(at(x, y));
        if (pixel == nullptr) {
            const Pixel& like = y >= size_.height ? above : x < 0 ? upper_right : left;
            now.depth = like.depth;
            now.valid = like.valid;
            return;
        }
        const auto mean = std::uint16_t((left.depth + above.depth + 1) >> 1);
        const std::uint16_t low = std::min(left.depth, above.depth);
        const std::uint16_t high = std::max(left.depth, above.depth);
        const auto gradient = std::uint16_t(left.depth + above.depth - upper_left.depth);
        const std::uint16_t median = std::max(low, std::min(high, gradient));
        const std::uint16_t straight = linear(x, y, before, mean);

        std::uint16_t candidate[4] = {median, left.depth, above.depth, straight};
        if (before != nullptr) {
            candidate[1] = before->at(x, y).depth;
            candidate[2] = std::uint16_t(
                candidate[1] + half(std::uint16_t(left.depth - before->at(x - 1, y).depth +
                                                  above.depth - before->at(x, y - 1).depth)));
        }
        std::uint16_t prediction = median;
        if (blend_)
            prediction = choose(candidate, x, y);

        const auto aside = std::int16_t(straight - prediction);
        const int how_far = distance(straight, prediction);
        const int side = (how_far >= 1) + (how_far >= 4);
        const int activity =
            2 * left.residual + above.residual * 2 + upper_left.residual + upper_right.residual;
        int level = 0;
        for (const std::uint16_t bound : activity_bounds)
            level += activity >= bound;
        const int around = 2 * (left.valid + above.valid) + upper_left.valid + upper_right.valid;
        const int earlier = before == nullptr
                                ? 3
                                : 2 * before->at(x, y).valid +
                                      (before->at(x + 1, y).valid & before->at(x, y + 1).valid);
        const int neighbourhood = 4 * around + earlier;
        const int context =
            neighbourhood == 27 ? 3 * level + side : int(mixed_contexts) + neighbourhood;

        Token token{hole_token, 0};
        now.valid = *pixel != 0 && *pixel != 0xffff;
        now.depth = prediction;
        if (*pixel == 0xffff)
            token.token = top_token;
        if (now.valid) {
            now.depth = *pixel;
            const auto difference = std::uint16_t(*pixel - prediction);
            token = token_of(zigzag16(aside < 0 ? std::uint16_t(0 - difference) : difference));
            now.residual = std::min(255, distance(*pixel, prediction));
        }
        for (int i = 0; i < 4; ++i)
            now.error[i] = std::min(255, distance(now.depth, candidate[i]));
        coded.push_back({std::uint16_t(context * int(token_count) + int(token.token)),
                         std::uint16_t(token.extra)});
    }

    std::uint16_t choose(const std::uint16_t (&candidate)[4], int x, int y) const {
        int error[4];
        for (int i = 0; i < 4; ++i)
            error[i] = at(x - 1, y - 1).error[i] + at(x, y - 1).error[i] +
                       at(x + 1, y - 1).error[i] + at(x - 1, y).error[i] + at(x - 2, y).error[i];
        // Two pairs compete, then their winners. The second best is the better of the
        // losing finalist and the first opponent of the winner; ties go to the former.
        const int a = error[1] < error[0] ? 1 : 0, b = error[3] < error[2] ? 3 : 2;
        const bool later = error[b] < error[a];
        const int best = later ? b : a, finalist = later ? a : b;
        const int partner = best ^ 1;
        const int second = error[partner] < error[finalist] ? partner : finalist;
        if (2 * error[second] < 3 * error[best])
            return std::uint16_t((candidate[best] + candidate[second] + 1) >> 1);
        return candidate[best];
    }

    Size size_;
    Weights weights_;
    bool blend_;
    std::vector<Pixel> pixels_;
};

}  // namespace theatron::codec::strata
