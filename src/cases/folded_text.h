// SPDX-License-Identifier: Apache-2.0
// Words without the differences with which programs write the same name: "MÜLLER^Anna", "Müller,
// Anna" and "Mueller Anna".
//
// Pure functions on UTF-8. Safe for any bytes; those that are no character stay as they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace theatron::cases {

// How umlauts and their like become ASCII: "Müller" is "muller" or "mueller".
enum class Umlaut { as_one_letter, as_two_letters };

// Where words end: at separators only, or also between a small letter and a capital, and between
// letters and digits.
enum class Split { at_separators, at_changes };

// The words of a text in small basic letters and digits: without accents, "ß" as "ss". Greek and
// Cyrillic letters become small and lose their accents, those of other scripts stay.
std::vector<std::string> folded_words(std::string_view text, Umlaut umlaut, Split split);

std::string joined(const std::vector<std::string>& words);

// True if both texts can be the same name: equal letters in the same order, with umlauts as one
// letter or as two in either.
bool is_same_name(std::string_view a, std::string_view b);

}  // namespace theatron::cases
