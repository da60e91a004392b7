// SPDX-License-Identifier: Apache-2.0
// The language in which this program speaks to its person.
//
// One for the whole program: a host and all logs, figures and files stay English, whatever it is.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace theatron {

enum class Language { english, german };

// English until it was set. Set it before other threads begin to speak; safe from any thread.
Language language();
void set_language(Language language);

// "de", "de-AT", "de_DE.UTF-8", "en"; none of these: empty.
std::optional<Language> parse_language(std::string_view text);

// A sentence in every language. {0} to {9} are the places of its arguments.
struct Sentence {
    std::string_view english, german;

    constexpr std::string_view in(Language which) const {
        return which == Language::german ? german : english;
    }
};

// The sentence with the arguments in their places; "?" for one that is missing.
std::string filled_in(std::string_view sentence, const std::vector<std::string>& arguments);

}  // namespace theatron
