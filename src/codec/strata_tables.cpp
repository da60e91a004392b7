// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace theatron::codec::strata {
namespace {

// 64 * 2^((level - 1) / 2), rounded; 0 for level 0.
constexpr std::array<std::uint32_t, max_level + 1> level_weights() {
    std::array<std::uint32_t, max_level + 1> weights{};
    for (unsigned i = 0; i < max_level; ++i)
        weights[i + 1] = (i % 2 == 0 ? 64u : 91u) << (i / 2);
    return weights;
}
constexpr auto weights = level_weights();

// The level nearest to 2^11 * count / total.
std::uint8_t nearest_level(std::uint32_t count, std::uint32_t total) {
    const double frequency = double(count) * probability_sum / total;
    if (frequency <= 1)
        return 1;
    return std::uint8_t(1 + std::lround(2 * std::log2(frequency)));
}

// Computes frequencies of one context that sum up to 2048, each at least 1.
void spread(const std::array<std::uint8_t, used_tokens>& levels, std::uint32_t* frequency) {
    std::uint32_t sum = 0;
    for (const std::uint8_t level : levels)
        sum += weights[level];
    if (sum == 0)
        return;
    std::uint32_t given = 0;
    for (unsigned t = 0; t < used_tokens; ++t) {
        if (levels[t] == 0)
            continue;
        const std::uint32_t share = (weights[levels[t]] * probability_sum + sum / 2) / sum;
        frequency[t] = std::max(1u, share);
        given += frequency[t];
    }
    // The most frequent token absorbs the rounding error of the sum.
    while (given != probability_sum) {
        std::uint32_t& most = *std::max_element(frequency, frequency + used_tokens);
        const std::uint32_t change = given < probability_sum
                                         ? probability_sum - given
                                         : 0u - std::min(given - probability_sum, (most + 1) / 2);
        most += change;
        given += change;
    }
}

// Models for the change of one level, by its value before and its predecessor.
struct LevelModels {
    AdaptiveBit changed[3][2];  // by level before (0, 1, more) and by "the last token changed"
    AdaptiveBit rises[3];
    AdaptiveBit further[3][max_level];
    AdaptiveBit context_changed;
};

unsigned kind_of(std::uint8_t level) {
    return std::min<unsigned>(level, 2);
}

}  // namespace

void choose_levels(const Counts& counts, const Levels& before, Levels& levels) {
    constexpr double cost_of_change = 3;  // bits, estimated
    levels = before;
    for (unsigned c = 0; c < coded_contexts; ++c) {
        const std::uint32_t* count = counts.data() + std::size_t(c) * token_count;
        std::uint32_t total = 0;
        for (unsigned t = 0; t < used_tokens; ++t)
            total += count[t];
        if (total == 0)
            continue;
        for (unsigned t = 0; t < used_tokens; ++t) {
            std::uint8_t& level = levels[c][t];
            if (count[t] == 0) {
                // An unused token with a level above 0 takes probability from the others.
                const double share = std::exp2((level - 1) * 0.5) / probability_sum;
                if (level != 0 && total * share * 1.44 > cost_of_change)
                    level = 0;
                continue;
            }
            const std::uint8_t wanted = nearest_level(count[t], total);
            const double off = (int(wanted) - int(level)) * 0.3466;  // natural logarithm
            if (level == 0 || count[t] * off * off * 0.72 > cost_of_change)
                level = wanted;
        }
    }
}

void put_levels(const Levels& levels, const Levels& before, SideWriter& side) {
    LevelModels m;
    for (unsigned c = 0; c < coded_contexts; ++c) {
        const bool context_changed = levels[c] != before[c];
        side.put(context_changed, m.context_changed);
        if (!context_changed)
            continue;
        bool last_changed = false;
        for (unsigned t = 0; t < used_tokens; ++t) {
            const int guess = before[c][t];
            const int level = levels[c][t];
            const unsigned kind = kind_of(before[c][t]);
            side.put(level != guess, m.changed[kind][last_changed]);
            last_changed = level != guess;
            if (!last_changed)
                continue;
            const bool rises = level > guess;
            if (guess != 0 && guess != int(max_level))
                side.put(rises, m.rises[kind]);
            const int most = rises ? int(max_level) - guess : guess;
            const int change = std::abs(level - guess);
            for (int i = 1; i < most; ++i) {
                side.put(change > i, m.further[kind][i - 1]);
                if (change == i)
                    break;
            }
        }
    }
}

bool get_levels(const Levels& before, Levels& levels, SideReader& side) {
    LevelModels m;
    levels = before;
    for (unsigned c = 0; c < coded_contexts; ++c) {
        if (!side.get(m.context_changed))
            continue;
        bool last_changed = false;
        for (unsigned t = 0; t < used_tokens; ++t) {
            const int guess = before[c][t];
            const unsigned kind = kind_of(before[c][t]);
            last_changed = side.get(m.changed[kind][last_changed]);
            if (!last_changed)
                continue;
            bool rises = guess == 0;
            if (guess != 0 && guess != int(max_level))
                rises = side.get(m.rises[kind]);
            const int most = rises ? int(max_level) - guess : guess;
            int change = 1;
            while (change < most && side.get(m.further[kind][change - 1]))
                ++change;
            levels[c][t] = std::uint8_t(rises ? guess + change : guess - change);
        }
    }
    return true;
}

void make_frequencies(const Levels& levels, Frequencies& frequencies) {
    frequencies.of.fill(0);
    for (unsigned c = 0; c < coded_contexts; ++c) {
        std::uint32_t* of = frequencies.of.data() + std::size_t(c) * token_count;
        spread(levels[c], of);
        std::uint32_t start = 0;
        for (unsigned t = 0; t < used_tokens; ++t) {
            const std::uint32_t frequency = of[t];
            of[t] |= start << 16;
            start += frequency;
        }
    }
    frequencies.of[std::size_t(idle_context) * token_count] = probability_sum;
}

const SlotTable& Slots::of(const Levels& levels) {
    constexpr std::uint32_t sum = probability_sum;
    if (!made_) {
        // The idle context keeps every state as it is and decodes a hole.
        std::uint32_t* slot = table_.data() + std::size_t(idle_context) * sum;
        for (std::uint32_t i = 0; i < sum; ++i)
            slot[i] = hole_token | i << 8 | sum << 20;
    }
    for (unsigned c = 0; c < coded_contexts; ++c) {
        if (made_ && levels_[c] == levels[c])
            continue;
        std::uint32_t of[used_tokens] = {};
        spread(levels[c], of);
        std::uint32_t* slot = table_.data() + std::size_t(c) * sum;
        std::uint32_t* const end = slot + sum;
        for (unsigned t = 0; t < used_tokens; ++t) {
            for (std::uint32_t i = 0; i < of[t]; ++i)
                slot[i] = t | i << 8 | of[t] << 20;
            slot += of[t];
        }
        // The slots of a context without a table are all holes.
        for (std::uint32_t i = 0; slot != end; ++i)
            *slot++ = hole_token | i << 8 | sum << 20;
    }
    levels_ = levels;
    made_ = true;
    return table_;
}

}  // namespace theatron::codec::strata
