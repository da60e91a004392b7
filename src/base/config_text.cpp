// SPDX-License-Identifier: Apache-2.0
#include "base/config_text.h"

#include <algorithm>

#include "base/outside_text.h"
#include "base/trimmed.h"

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

void parse_line(std::string_view text, int number, ConfigText& config) {
    const auto refuse = [&](std::string_view key, const std::string& why) {
        config.mistakes.push_back({number, std::string(key), why});
    };
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(text.substr(0, equals));
    if (!is_key(key)) {
        // Behind the first word may stand a token.
        const std::string shown =
            clean_text(key.substr(0, key.find_first_of(" \t:")), shown_characters);
        if (shown.starts_with("--") && is_key(shown.substr(2)))
            return refuse("", "write '" + shown.substr(2) + "' without the hyphens before it");
        if (key.starts_with("["))
            return refuse("", "there are no sections in brackets; lines are KEY = VALUE");
        return refuse("", "'" + shown + "' is no key; lines are KEY = VALUE");
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
    config.lines.push_back({number, std::string(key), std::string(value)});
}

}  // namespace

ConfigText parse_config(std::string_view text) {
    ConfigText config;
    if (text.size() > max_config_bytes) {
        config.mistakes.push_back({0, "", "it is larger than 64 KiB"});
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
