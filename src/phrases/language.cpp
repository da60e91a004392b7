// SPDX-License-Identifier: Apache-2.0
#include "phrases/language.h"

#include <atomic>

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
    if (name == "de")
        return Language::german;
    if (name == "en")
        return Language::english;
    return std::nullopt;
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

}  // namespace theatron
