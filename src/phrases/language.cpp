// SPDX-License-Identifier: Apache-2.0
#include "phrases/language.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace theatron {
namespace {

std::atomic<Language> spoken{Language::english};

}  // namespace

Language language() {
    return spoken.load(std::memory_order_relaxed);
}

void set_language(Language language) {
    spoken.store(language, std::memory_order_relaxed);
}

std::optional<Language> parse_language(std::string_view text) {
    const std::string_view name = text.substr(0, text.find_first_of("-_.@"));
    const auto* found =
        std::find_if(std::begin(languages), std::end(languages),
                     [&](const LanguageFacts& facts) { return facts.code == name; });
    if (found == std::end(languages))
        return std::nullopt;
    return Language(found - std::begin(languages));
}

std::string filled_in(std::string_view sentence, const std::vector<std::string>& arguments) {
    std::string result;
    for (std::size_t i = 0; i < sentence.size(); ++i) {
        if (sentence[i] != '{') {
            result += sentence[i];
            continue;
        }
        const auto argument = std::size_t(sentence[i + 1] - '0');
        result += argument < arguments.size() ? arguments[argument] : "?";
        i += 2;
    }
    return result;
}

std::string decimal(std::string number, Language which) {
    std::replace(number.begin(), number.end(), '.', facts_of(which).decimal_sign);
    return number;
}

}  // namespace theatron
