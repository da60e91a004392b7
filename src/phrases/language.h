// SPDX-License-Identifier: Apache-2.0
// The languages in which this program speaks to its person.
//
// One at a time for the whole program: a host and all logs, figures and files stay English,
// whatever it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace theatron {

// In the order of the columns of all tables of texts. Another language has one more member here,
// its facts below, and one more text in each row; until then the tables do not compile. The page
// has a table of its own: apps/web/page/texts.js.
enum class Language { english, german, french };

struct LanguageFacts {
    std::string_view code;  // as browsers and systems begin its name
    std::string_view name;  // in English
    char decimal_sign;
};
inline constexpr LanguageFacts languages[] = {
    {"en", "English", '.'},
    {"de", "German", ','},
    {"fr", "French", ','},
};
inline constexpr std::size_t language_count = std::size(languages);

constexpr const LanguageFacts& facts_of(Language language) {
    return languages[std::size_t(language)];
}

// English until it was set. Set it before other threads begin to speak; safe from any thread.
Language language();
void set_language(Language language);

// "de", "de-AT", "de_DE.UTF-8", "en"; a language that has no texts: empty.
std::optional<Language> parse_language(std::string_view text);

// A sentence in every language. {0} to {9} are the places of its arguments.
class Sentence {
public:
    constexpr Sentence() = default;  // says nothing
    // In the order of Language; a row with another number of texts does not compile.
    template <class... Texts>
    constexpr Sentence(std::string_view first, Texts... others) : texts_{first, others...} {
        static_assert(1 + sizeof...(Texts) == language_count, "a text for each language");
    }

    constexpr std::string_view in(Language which) const { return texts_[std::size_t(which)]; }

    constexpr bool is_complete() const {
        return std::none_of(std::begin(texts_), std::end(texts_),
                            [](std::string_view text) { return text.empty(); });
    }
    constexpr bool is_empty() const {
        return std::all_of(std::begin(texts_), std::end(texts_),
                           [](std::string_view text) { return text.empty(); });
    }

private:
    std::string_view texts_[language_count];
};

// The sentence with the arguments in their places; "?" for one that is missing.
std::string filled_in(std::string_view sentence, const std::vector<std::string>& arguments);

// "0,8" in German and French: a decimal number that was written with a point.
std::string decimal(std::string number, Language which = language());

}  // namespace theatron
