// SPDX-License-Identifier: Apache-2.0
#include "base/shown_name.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/basic_letters.h"
#include "base/outside_text.h"
#include "base/utf8.h"

namespace theatron {
namespace {

// Removes the first character of `text`, which is not empty, and returns it.
char32_t take_letter(std::string_view& text, std::string_view& bytes) {
    const Utf8Character first = first_character(text);
    bytes = text.substr(0, first.bytes);
    text.remove_prefix(first.bytes);
    return first.code;
}

bool is_within(char32_t c, char32_t first, char32_t last) {
    return c >= first && c <= last;
}

// Those that Unicode calls "default ignorable", and annotations.
bool is_invisible(char32_t c) {
    return c == 0xad || c == 0x34f || is_within(c, 0x115f, 0x1160) ||
           is_within(c, 0x17b4, 0x17b5) || is_within(c, 0x180b, 0x180f) ||
           is_within(c, 0x200b, 0x200f) || is_within(c, 0x2060, 0x206f) || c == 0x3164 ||
           is_within(c, 0xfe00, 0xfe0f) || c == 0xffa0 || is_within(c, 0xfff0, 0xfffb) ||
           is_within(c, 0x1bca0, 0x1bca3) || is_within(c, 0x1d173, 0x1d17a) ||
           is_within(c, 0xe0000, 0xe0fff);
}

// U+2800 is a pattern of Braille without dots.
bool is_space(char32_t c) {
    return c == ' ' || c == 0xa0 || c == 0x1680 || is_within(c, 0x2000, 0x200a) || c == 0x202f ||
           c == 0x205f || c == 0x2800 || c == 0x3000;
}

// Commas and semicolons of all alphabets, and what looks like one.
bool is_comma(char32_t c) {
    return c == ',' || c == ';' || c == 0x37e || c == 0x55d || c == 0x60c || c == 0x61b ||
           c == 0x201a || c == 0x2e41 || c == 0x3001 || is_within(c, 0xfe10, 0xfe11) ||
           is_within(c, 0xfe50, 0xfe51) || c == 0xff0c || c == 0xff1b || c == 0xff64;
}

// Messages stand behind the names of their authors and a colon.
bool is_colon(char32_t c) {
    return c == ':' || c == 0x2d0 || c == 0x589 || c == 0x5c3 || c == 0x703 || c == 0x2236 ||
           c == 0xa789 || c == 0xfe13 || c == 0xfe55 || c == 0xff1a;
}

// Lines of operators name people by number, as in "#58".
bool is_number_sign(char32_t c) {
    return c == '#' || c == 0xfe5f || c == 0xff03;
}

constexpr std::u32string_view opening =
    U"([{<\u2039\u2045\u207d\u208d\u2329\u2768\u276a\u27e8\u27ee"
    U"\u3008\u3010\u3014\uff08\uff1c\uff3b\uff5b";
constexpr std::u32string_view closing =
    U")]}>\u203a\u2046\u207e\u208e\u232a\u2769\u276b\u27e9\u27ef"
    U"\u3009\u3011\u3015\uff09\uff1e\uff3d\uff5d";

// Small letters of other alphabets that look like a Latin one, they or their capitals.
struct Lookalike {
    char32_t letter;
    char latin;
};
constexpr Lookalike lookalikes[] = {
    {0x3b1, 'a'}, {0x3b2, 'b'}, {0x3b5, 'e'}, {0x3b6, 'z'}, {0x3b7, 'h'}, {0x3b9, 'i'},
    {0x3ba, 'k'}, {0x3bc, 'm'}, {0x3bd, 'n'}, {0x3bf, 'o'}, {0x3c1, 'p'}, {0x3c4, 't'},
    {0x3c5, 'y'}, {0x3c7, 'x'},  // Greek
    {0x430, 'a'}, {0x432, 'b'}, {0x435, 'e'}, {0x43a, 'k'}, {0x43c, 'm'}, {0x43d, 'h'},
    {0x43e, 'o'}, {0x440, 'p'}, {0x441, 'c'}, {0x442, 't'}, {0x443, 'y'}, {0x445, 'x'},
    {0x450, 'e'}, {0x455, 's'}, {0x456, 'i'}, {0x457, 'i'}, {0x458, 'j'}, {0x4bb, 'h'},
    {0x501, 'd'}, {0x51b, 'q'}, {0x51d, 'w'},  // Cyrillic
};

char32_t look_of_letter(char32_t c) {
    if (is_within(c, 0xff01, 0xff5e))  // of full width
        c -= 0xfee0;
    if (c == 0xd7 || c == 0xf7)  // multiplied, divided
        return 'x';
    if (c == 0xde || c == 0xfe)  // thorn
        return 'p';
    if (const char basic = basic_letter(c); basic != ' ')
        return char32_t(basic);
    c = small_basic_letter(c >= 'A' && c <= 'Z' ? c + 0x20 : c);
    const auto found = std::find_if(std::begin(lookalikes), std::end(lookalikes),
                                    [&](const Lookalike& known) { return known.letter == c; });
    return found == std::end(lookalikes) ? c : char32_t(found->latin);
}

// I and l are the same in many fonts.
char32_t without_mix_ups(char32_t c) {
    return c == 'i' || c == '1' || c == '|' ? U'l' : c == '0' ? U'o' : c;
}

}  // namespace

std::string clean_name(std::string_view text, std::size_t max_characters) {
    const std::string clean = clean_text(text, std::numeric_limits<std::size_t>::max());
    std::string name;
    std::string_view rest = clean, bytes;
    while (!rest.empty()) {
        const char32_t c = take_letter(rest, bytes);
        if (is_invisible(c))
            continue;
        if (!is_space(c))
            name += bytes;
        else if (!name.empty())
            name += ' ';
    }
    name = clean_text(name, max_characters);
    name.erase(name.find_last_not_of(' ') + 1);
    return name;
}

namespace {

// In brackets, whole or a word of it.
bool has_fact(std::string_view inside, const std::vector<std::string>& facts) {
    const auto is_fact = [&](const std::string& text) {
        const std::string look = look_of(text);
        return std::any_of(facts.begin(), facts.end(),
                           [&](const std::string& fact) { return look == look_of(fact); });
    };
    std::string word;
    for (const char c : inside) {
        const bool is_letter = std::uint8_t(c) >= 0x80 || (c >= 'a' && c <= 'z') ||
                               (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '|';
        if (!is_letter && is_fact(std::exchange(word, {})))
            return true;
        if (is_letter)
            word += c;
    }
    return is_fact(word) || is_fact(std::string(inside));
}

// `name` without its first brackets that have one of the facts; brackets that nothing closes end
// with the name.
std::string without_brackets(const std::string& name, const std::vector<std::string>& facts) {
    std::string_view rest = name, bytes;
    while (!rest.empty()) {
        const std::size_t begin = name.size() - rest.size();
        if (opening.find(take_letter(rest, bytes)) == opening.npos)
            continue;
        const std::size_t inside = name.size() - rest.size();
        std::size_t inside_end = name.size(), end = name.size();
        for (std::string_view after = rest; !after.empty();) {
            const std::size_t here = name.size() - after.size();
            if (closing.find(take_letter(after, bytes)) == closing.npos)
                continue;
            inside_end = here;
            end = name.size() - after.size();
            break;
        }
        if (has_fact(std::string_view(name).substr(inside, inside_end - inside), facts))
            return clean_name(name.substr(0, begin), name.size()) + ' ' +
                   clean_name(name.substr(end), name.size());
    }
    return name;
}

}  // namespace

std::string person_name(std::string_view text, const std::vector<std::string>& facts,
                        std::size_t max_characters) {
    const std::string clean = clean_name(text, std::numeric_limits<std::size_t>::max());
    std::string name;
    std::string_view rest = clean, bytes;
    while (!rest.empty()) {
        const char32_t letter = take_letter(rest, bytes);
        const bool is_separator = is_comma(letter) || is_colon(letter) || is_number_sign(letter);
        if (!is_separator)
            name += bytes;
        else if (!name.ends_with(' ') && !rest.starts_with(' '))
            name += ' ';
    }
    for (std::string before; before != name;) {
        before = name;
        name = clean_name(without_brackets(name, facts), max_characters);
    }
    return name;
}

std::string look_of(std::string_view name) {
    std::string look;
    std::string_view bytes;
    while (!name.empty()) {
        const char32_t read = take_letter(name, bytes);
        if (is_within(read, 0x300, 0x36f) || is_space(read))  // an accent on its own
            continue;
        const char32_t c = without_mix_ups(look_of_letter(read));
        if (c < 0x80)
            look += char(c);
        else if (c == read)
            look += bytes;
        else
            // Only letters of two bytes have become others.
            look += {char(0xc0 | c >> 6), char(0x80 | (c & 0x3f))};
    }
    return look;
}

std::string told_apart(const std::string& name, const std::vector<std::string>& others,
                       std::size_t max_characters) {
    std::vector<std::string> looks;
    for (const std::string& other : others)
        looks.push_back(look_of(other));
    const auto is_taken = [&](const std::string& text) {
        return std::find(looks.begin(), looks.end(), look_of(text)) != looks.end();
    };
    std::string shown = name;
    for (std::size_t number = 2; is_taken(shown); ++number) {
        const std::string behind = " (" + std::to_string(number) + ")";
        shown = clean_text(name, max_characters - std::min(max_characters, behind.size())) + behind;
    }
    return shown;
}

}  // namespace theatron
