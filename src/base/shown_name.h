// SPDX-License-Identifier: Apache-2.0
// Names that people give to themselves and to sessions, and by which others know them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace theatron {

// As clean_text(), also without characters that nobody sees (joiners, variation selectors, soft
// hyphens, fillers), with plain spaces in place of all others, and none around it. Safe for any
// bytes.
std::string clean_name(std::string_view text, std::size_t max_characters);

// As clean_name(), for names of people, behind which lists put facts in brackets, and commas
// between them, whom lines of operators name by number ("#58"), and behind whose names and a colon
// their messages stand. A name imitates none of these: it has spaces in place of commas, colons and
// number signs, and no brackets with one of `facts` among
// their words, in any letters that look_of() takes for the same.
std::string person_name(std::string_view text, const std::vector<std::string>& facts,
                        std::size_t max_characters);

// Equal texts for names that are easily taken for each other: in capital or small letters, with or
// without accents and spaces, with Cyrillic or Greek letters that look like Latin ones, or with 1
// for l and 0 for O. For comparison, not to be shown. `name` is clean.
std::string look_of(std::string_view name);

// `name`, with the lowest number from 2 behind it that is needed to look like none of `others`.
// All are clean. The name is cut where the number needs the place.
std::string told_apart(const std::string& name, const std::vector<std::string>& others,
                       std::size_t max_characters);

}  // namespace theatron
