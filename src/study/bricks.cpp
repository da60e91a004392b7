// SPDX-License-Identifier: Apache-2.0
#include "study/bricks.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>

#include "base/split_mix.h"

namespace theatron::study {
namespace {

constexpr int side_studs = 12, layers = 6;
constexpr std::pair<int, int> sizes[] = {{1, 2}, {1, 4}, {2, 2}, {2, 3}, {2, 4}};

BrickColor random_color(SplitMix& random) {
    return BrickColor(random.below(brick_colors));
}

bool is_free(const Construction& construction, const Brick& brick) {
    return brick.x >= 0 && brick.y >= 0 && brick.x + brick.width <= side_studs &&
           brick.y + brick.depth <= side_studs && brick.layer >= 0 && brick.layer < layers &&
           std::none_of(
               construction.bricks.begin(), construction.bricks.end(),
               [&](const Brick& b) { return b.layer == brick.layer && overlaps(b, brick); });
}

Brick random_brick(SplitMix& random) {
    Brick brick;
    const auto [short_side, long_side] = sizes[random.below(std::size(sizes))];
    const bool turned = random.below(2) == 1;
    brick.width = turned ? long_side : short_side;
    brick.depth = turned ? short_side : long_side;
    brick.color = random_color(random);
    return brick;
}

// At a random place where it holds to `other`, above or below.
Brick attached(Brick brick, const Brick& other, SplitMix& random) {
    const auto along = [&](int own, int begin, int length) {
        return begin - own + 1 + int(random.below(std::uint64_t(own + length - 1)));
    };
    brick.x = along(brick.width, other.x, other.width);
    brick.y = along(brick.depth, other.y, other.depth);
    brick.layer = other.layer + (random.below(3) > 0 ? 1 : -1);
    return brick;
}

std::map<std::string, int> kinds_of(const std::vector<Brick>& bricks) {
    std::map<std::string, int> kinds;
    for (const Brick& brick : bricks)
        ++kinds[kind_of(brick)];
    return kinds;
}

std::string listed_kinds(const std::vector<Brick>& bricks) {
    std::string text;
    for (const auto& [kind, count] : kinds_of(bricks))
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
    return text;
}

// A set with which the construction can be built, or cannot: then one brick is another one.
std::vector<Brick> set_for(const Construction& construction, bool buildable, SplitMix& random) {
    while (true) {
        std::vector<Brick> set = construction.bricks;
        if (!buildable)
            set[random.below(set.size())] = random_brick(random);
        for (std::uint64_t more = random.below(3); more > 0; --more)
            set.push_back(random_brick(random));
        if (can_be_built(construction, set) == buildable)
            return set;
    }
}

}  // namespace

const char* name_of(BrickColor color) {
    constexpr const char* names[brick_colors] = {"red",   "blue",  "yellow",
                                                 "green", "white", "black"};
    return names[int(color)];
}

const char* code_of(BrickColor color) {
    constexpr const char* codes[brick_colors] = {"#c4281b", "#0d69ac", "#f5cd2f",
                                                 "#287f47", "#f2f3f2", "#333333"};
    return codes[int(color)];
}

bool overlaps(const Brick& a, const Brick& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.depth && b.y < a.y + a.depth;
}

std::string kind_of(const Brick& brick) {
    return std::string(name_of(brick.color)) + " " +
           std::to_string(std::min(brick.width, brick.depth)) + "x" +
           std::to_string(std::max(brick.width, brick.depth));
}

Construction make_construction(std::uint64_t seed, int bricks) {
    assert(bricks >= 1);
    SplitMix random(mixed(seed));
    Construction construction;
    Brick first = random_brick(random);
    first.x = (side_studs - first.width) / 2;
    first.y = (side_studs - first.depth) / 2;
    construction.bricks.push_back(first);
    while (int(construction.bricks.size()) < bricks) {
        const Brick& other = construction.bricks[random.below(construction.bricks.size())];
        const Brick brick = attached(random_brick(random), other, random);
        if (is_free(construction, brick))
            construction.bricks.push_back(brick);
    }
    std::stable_sort(construction.bricks.begin(), construction.bricks.end(),
                     [](const Brick& a, const Brick& b) { return a.layer < b.layer; });
    return construction;
}

int count_bricks(const Construction& construction, BrickColor color) {
    return int(std::count_if(construction.bricks.begin(), construction.bricks.end(),
                             [&](const Brick& brick) { return brick.color == color; }));
}

int free_studs(const Construction& construction, BrickColor color) {
    int count = 0;
    for (const Brick& brick : construction.bricks)
        for (int i = 0; brick.color == color && i < brick.width * brick.depth; ++i) {
            Brick above;
            above.width = above.depth = 1;
            above.x = brick.x + i % brick.width;
            above.y = brick.y + i / brick.width;
            count += std::none_of(
                construction.bricks.begin(), construction.bricks.end(), [&](const Brick& other) {
                    return other.layer == brick.layer + 1 && overlaps(other, above);
                });
        }
    return count;
}

bool can_be_built(const Construction& construction, const std::vector<Brick>& set) {
    const auto there = kinds_of(set);
    for (const auto& [kind, count] : kinds_of(construction.bricks)) {
        const auto found = there.find(kind);
        if (found == there.end() || found->second < count)
            return false;
    }
    return true;
}

std::vector<BrickQuestion> make_questions(const Construction& construction, std::uint64_t seed,
                                          int count) {
    SplitMix random(mixed(seed ^ 0x7175657374));
    std::vector<BrickQuestion> questions;
    std::set<std::string> texts;
    while (int(questions.size()) < count) {
        BrickQuestion question;
        question.kind = BrickQuestion::Kind(questions.size() % 3);
        const BrickColor color = random_color(random);
        // Colours that are there come first; about one that is not, the answer is 0.
        const bool rare = count_bricks(construction, color) == 0 && random.below(8) > 0;
        if (question.kind == BrickQuestion::Kind::buildable) {
            const auto set = set_for(construction, random.below(2) == 1, random);
            question.answer = can_be_built(construction, set);
            question.text =
                "Can the construction be built with these bricks: " + listed_kinds(set) + "?";
        } else if (rare) {
            continue;
        } else if (question.kind == BrickQuestion::Kind::bricks) {
            question.answer = count_bricks(construction, color);
            question.text =
                std::string("How many ") + name_of(color) + " bricks are in the construction?";
        } else {
            question.answer = free_studs(construction, color);
            question.text = std::string("How many ") + name_of(color) +
                            " studs are free, with no brick on them?";
        }
        if (texts.insert(question.text).second)
            questions.push_back(std::move(question));
    }
    return questions;
}

}  // namespace theatron::study
