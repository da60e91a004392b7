// SPDX-License-Identifier: Apache-2.0
// Questionnaires as data: items, their points, and the scales that are computed from them.
//
// The text of a file of questionnaires has lines "KEY = VALUE" (base/config_text.h):
//
//   questionnaire = comfort        # begins one
//     title = Comfort
//     lowest = 0                   # points of the items that follow; usual: 0 to 6, step 1
//     highest = 6
//     anchors = not at all | very much
//     scale = sickness | Sickness  # begins a scale
//       from = mean                # or sum
//       factor = 100/6             # usual: 1
//       zero-based = yes           # the lowest point counts as 0
//     scale = total | Total
//       from = mean of sickness other
//     item = c1 sickness           # begins an item; a scale named twice counts it twice
//       text = I felt sick.
//       reversed = yes
//     item = c2
//       choices = never | sometimes | always     # not scored
//
// A file may give texts to a questionnaire that is known already: its lines are then `anchors`,
// `item = ID` and below it `text` and `anchors`.
//
// Pure and safe for any bytes.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/config_text.h"

namespace theatron::study {

inline constexpr std::size_t max_questionnaires = 32;  // in all files of a study
inline constexpr std::size_t max_items = 200;          // of a questionnaire
inline constexpr std::size_t max_scales = 32;
inline constexpr std::size_t max_choices = 20;
inline constexpr std::size_t max_text_bytes = 1000;
inline constexpr int max_points = 1000;

struct Item {
    std::string id;
    std::string text;         // empty: the researcher has to supply it
    std::string left, right;  // what the lowest and the highest point mean
    int lowest = 0, highest = 6, step = 1;
    bool reversed = false;
    std::vector<std::string> choices;  // not empty: one of these is chosen instead of a point
    std::vector<std::size_t> scales;   // indices; several times where it counts several times
};

struct Scale {
    enum class From { mean, sum, mean_of_scales };
    std::string id, title;
    From from = From::mean;
    double factor = 1;
    bool zero_based = false;
    std::vector<std::size_t> parts;  // indices of scales before this one
};

struct Questionnaire {
    std::string id, title;
    std::string source;    // the publication of its structure
    std::string texts_at;  // where the items' texts are published; empty: they are here
    std::vector<Scale> scales;
    std::vector<Item> items;

    bool has_texts() const;
    std::vector<std::string> items_without_text() const;
};

struct Questionnaires {
    std::vector<Questionnaire> all;
    const Questionnaire* find(std::string_view id) const;
};

// Adds those of `text` to `known`, and texts to those that are there. Returns all mistakes; with
// any of them `known` is as it was.
std::vector<ConfigMistake> add_questionnaires(std::string_view text, Questionnaires& known);

// A letter, then at most 31 letters, digits, '-' and '_'.
bool is_id(std::string_view text);
// "a | b | c" without the blanks around each.
std::vector<std::string> listed(std::string_view text);

// Points or number of the choice (from 1) by item; no entry: the question was left out.
using Replies = std::map<std::string, int>;

// The values of all scales in their order. nullopt: an item of the scale has no reply, so it has no
// value. Replies must be within the points of their items.
std::vector<std::optional<double>> scores(const Questionnaire& questionnaire,
                                          const Replies& replies);
// The lowest and the highest value that the scale can have.
std::pair<double, double> bounds(const Questionnaire& questionnaire, std::size_t scale);

}  // namespace theatron::study
