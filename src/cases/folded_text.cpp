// SPDX-License-Identifier: Apache-2.0
#include "cases/folded_text.h"

#include <algorithm>

#include "base/basic_letters.h"
#include "base/utf8.h"

namespace theatron::cases {
namespace {

// Basic letters of U+1E00 to U+1EFF, with those of Vietnamese; blank: none.
constexpr std::string_view additional_letters =
    "aabbbbbbccddddddddddeeeeeeeeeeff"
    "gghhhhhhhhhhiiiikkkkkkllllllllmm"
    "mmmmnnnnnnnnoooooooopppprrrrrrrr"
    "ssssssssssttttttttuuuuuuuuuuvvvv"
    "wwwwwwwwwwxxxxyyzzzzzzhtwyassssd"
    "aaaaaaaaaaaaaaaaaaaaaaaaeeeeeeee"
    "eeeeeeeeiiiioooooooooooooooooooo"
    "oooouuuuuuuuuuuuuuyyyyyyyyllvvyy";
static_assert(additional_letters.size() == 0x1f00 - 0x1e00);

// Letters of names between U+0180 and these: Romanian, Vietnamese, and Chinese in Latin letters.
struct BasicLetter {
    char32_t point;
    char basic;
};
constexpr BasicLetter single_letters[] = {
    {0x1a0, 'o'}, {0x1a1, 'o'}, {0x1af, 'u'}, {0x1b0, 'u'}, {0x1cd, 'a'}, {0x1ce, 'a'},
    {0x1cf, 'i'}, {0x1d0, 'i'}, {0x1d1, 'o'}, {0x1d2, 'o'}, {0x1d3, 'u'}, {0x1d4, 'u'},
    {0x1d5, 'u'}, {0x1d6, 'u'}, {0x1d7, 'u'}, {0x1d8, 'u'}, {0x1d9, 'u'}, {0x1da, 'u'},
    {0x1db, 'u'}, {0x1dc, 'u'}, {0x218, 's'}, {0x219, 's'}, {0x21a, 't'}, {0x21b, 't'},
};

bool has_two_letters(char32_t point) {
    constexpr char32_t umlauts[] = {0xc4, 0xd6, 0xdc, 0xe4, 0xf6, 0xfc,  0xc5,
                                    0xe5, 0xc6, 0xe6, 0xd8, 0xf8, 0x152, 0x153};
    return std::find(std::begin(umlauts), std::end(umlauts), point) != std::end(umlauts);
}

enum class Kind { other, digit, small, capital };

Kind kind_of(char32_t point) {
    if (point >= '0' && point <= '9')
        return Kind::digit;
    if ((point >= 'A' && point <= 'Z') || (point >= 0xc0 && point <= 0xde))
        return Kind::capital;
    return (point >= 'a' && point <= 'z') || (point >= 0xdf && point <= 0xff) ? Kind::small
                                                                              : Kind::other;
}

bool is_change(Kind before, Kind next) {
    return (before == Kind::digit) != (next == Kind::digit) ||
           (before == Kind::small && next == Kind::capital);
}

bool is_accent(char32_t point) {
    return point >= 0x300 && point < 0x370;
}

// Blank: the letter has none.
char basic_letter_of(char32_t point) {
    if (point >= 0x1e00 && point < 0x1f00)
        return additional_letters[point - 0x1e00];
    for (const BasicLetter& letter : single_letters)
        if (letter.point == point)
            return letter.basic;
    return basic_letter(point);
}

// A letter or digit in small basic letters. Empty: a separator.
std::string folded(char32_t point, std::string_view bytes, Umlaut umlaut) {
    if (point < 0x80) {
        const bool is_capital = point >= 'A' && point <= 'Z';
        const bool is_kept =
            is_capital || (point >= '0' && point <= '9') || (point >= 'a' && point <= 'z');
        return is_kept ? std::string(1, char(is_capital ? point - 'A' + 'a' : point)) : "";
    }
    if (const char basic = basic_letter_of(point); basic != ' ') {
        std::string letters(1, basic);
        if (point == 0xdf || point == 0x1e9e)
            letters += 's';
        else if (umlaut == Umlaut::as_two_letters && has_two_letters(point))
            letters += point == 0xc5 || point == 0xe5 ? 'a' : 'e';
        return letters;
    }
    if (point >= 0x370 && point < 0x530) {
        const char32_t small = small_basic_letter(point);
        return {char(0xc0 | small >> 6), char(0x80 | (small & 0x3f))};
    }
    const bool is_letter = point >= 0x180 && point != 0x2013 && point != 0x2014 && point != 0x3000;
    return is_letter ? std::string(bytes) : "";
}

}  // namespace

std::vector<std::string> folded_words(std::string_view text, Umlaut umlaut, Split split) {
    std::vector<std::string> words(1);
    Kind before = Kind::other;
    for (std::size_t at = 0; at < text.size();) {
        const Utf8Character character = first_character(text.substr(at));
        const char32_t point = character.code;
        const std::string_view bytes = text.substr(at, character.bytes);
        at += character.bytes;
        // An accent that follows its letter, as some systems write file names.
        if (is_accent(point)) {
            if (point == 0x308 && umlaut == Umlaut::as_two_letters)
                words.back() += 'e';
            continue;
        }
        const std::string letters = folded(point, bytes, umlaut);
        const Kind kind = kind_of(point);
        const bool ends =
            letters.empty() || (split == Split::at_changes && is_change(before, kind));
        if (ends && !words.back().empty())
            words.emplace_back();
        words.back() += letters;
        before = kind;
    }
    if (words.back().empty())
        words.pop_back();
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words)
        all += word;
    return all;
}

bool is_same_name(std::string_view a, std::string_view b) {
    constexpr Umlaut ways[] = {Umlaut::as_one_letter, Umlaut::as_two_letters};
    for (const Umlaut way_a : ways)
        for (const Umlaut way_b : ways)
            if (joined(folded_words(a, way_a, Split::at_separators)) ==
                joined(folded_words(b, way_b, Split::at_separators)))
                return true;
    return false;
}

}  // namespace theatron::cases
