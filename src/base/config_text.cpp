// SPDX-License-Identifier: Apache-2.0
#include "base/config_text.h"

#include <algorithm>

#include "base/outside_text.h"
#include "base/small_letters.h"
#include "base/trimmed.h"
#include "base/utf8.h"

namespace theatron {
namespace {

constexpr std::size_t shown_characters = 60;  // of what stands in the file
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool is_key(std::string_view text) {
    return !text.empty() && text.front() != '-' &&
           text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == text.npos;
}

bool has_control_characters(std::string_view text) {
    for (const char c : text)
        if (static_cast<unsigned char>(c) < ' ' && c != '\t')
            return true;
    return false;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const Utf8Character next = first_character(text);
        if (!next.valid)
            return false;
        text.remove_prefix(next.bytes);
    }
    return true;
}

// The mistake in a word that stands where a key should. `follows`: the text behind the word.
std::string mistake_of_word(std::string_view word, std::string_view follows) {
    const std::string shown = clean_text(word, shown_characters);
    if (shown.starts_with("--") && is_key(shown.substr(2)))
        return "write '" + shown.substr(2) + "' without the hyphens before it";
    if (shown.starts_with("["))
        return "there are no sections in brackets; lines are KEY = VALUE";
    if (is_key(shown) && follows.starts_with(':'))
        return "'" + shown + "' is followed by ':'; lines are KEY = VALUE";
    if (shown.starts_with(";") || shown.starts_with("//"))
        return "a comment begins with #";
    std::string hyphens = shown;
    std::replace(hyphens.begin(), hyphens.end(), '_', '-');
    if (hyphens != shown && is_key(hyphens) && trimmed(follows).empty())
        return "'" + shown + "' is no key; write '" + hyphens + "', with hyphens";
    const std::string small = in_small_letters(shown);
    if (small != shown && is_key(small) && trimmed(follows).empty())
        return "'" + shown + "' is no key; keys have small letters alone";
    return "'" + shown + "' is no key; lines are KEY = VALUE";
}

void parse_line(std::string_view text, int number, ConfigText& config) {
    const auto refuse = [&](std::string_view key, const std::string& why) {
        config.mistakes.push_back({number, std::string(key), why});
    };
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(text.substr(0, equals));
    if (!is_key(key)) {
        // Behind the first word may stand a token.
        const std::size_t end = std::min(key.find_first_of(" \t:"), key.size());
        return refuse("", mistake_of_word(key.substr(0, end), key.substr(end)));
    }
    if (equals == text.npos)
        return refuse(key, "there is no '='; lines are KEY = VALUE");
    std::string_view value = trimmed(text.substr(equals + 1));
    const bool begins = value.starts_with('"'), ends = value.size() > 1 && value.ends_with('"');
    if (begins != ends)
        return refuse(key, begins ? "the value begins with \" and does not end with it"
                                  : "the value ends with \" and does not begin with it");
    if (begins)
        value = value.substr(1, value.size() - 2);
    if (value.empty())
        return refuse(key, "there is no value; leave the line out for the usual one");
    if (has_control_characters(value))
        return refuse(key, "the value has control characters");
    if (!is_utf8(value))
        return refuse(key, "the value is not UTF-8; save the file in that encoding");
    config.lines.push_back({number, std::string(key), std::string(value)});
}

}  // namespace

ConfigText parse_config(std::string_view text) {
    ConfigText config;
    if (text.size() > max_config_bytes) {
        config.mistakes.push_back({0, "", "it is larger than 64 KiB"});
        return config;
    }
    if (text.find('\0') != text.npos || text.starts_with("\xff\xfe") ||
        text.starts_with("\xfe\xff")) {
        config.mistakes.push_back({0, "", "it is UTF-16, or no text; save it as UTF-8"});
        return config;
    }
    if (text.starts_with(byte_order_mark))
        text.remove_prefix(byte_order_mark.size());
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.empty() && line.front() != '#')
            parse_line(line, number, config);
    }
    return config;
}

std::string mistakes_text(const std::string& file, const std::vector<ConfigMistake>& mistakes) {
    std::string text;
    for (const ConfigMistake& mistake : mistakes) {
        text += (text.empty() ? "" : "\n") + file + ":";
        if (mistake.line > 0)
            text += std::to_string(mistake.line) + ":";
        text += " " + (mistake.key.empty() ? "" : mistake.key + ": ") + mistake.text;
        if (!text.ends_with('.'))
            text += ".";
    }
    return text;
}

}  // namespace theatron
