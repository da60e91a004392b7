// SPDX-License-Identifier: Apache-2.0
#include "cases/folded_text.h"

#include <algorithm>
#include <cstdint>

#include "base/basic_letters.h"

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
    std::uint32_t point;
    char basic;
};
constexpr BasicLetter single_letters[] = {
    {0x1a0, 'o'}, {0x1a1, 'o'}, {0x1af, 'u'}, {0x1b0, 'u'}, {0x1cd, 'a'}, {0x1ce, 'a'},
    {0x1cf, 'i'}, {0x1d0, 'i'}, {0x1d1, 'o'}, {0x1d2, 'o'}, {0x1d3, 'u'}, {0x1d4, 'u'},
    {0x1d5, 'u'}, {0x1d6, 'u'}, {0x1d7, 'u'}, {0x1d8, 'u'}, {0x1d9, 'u'}, {0x1da, 'u'},
    {0x1db, 'u'}, {0x1dc, 'u'}, {0x218, 's'}, {0x219, 's'}, {0x21a, 't'}, {0x21b, 't'},
};

struct SmallLetter {
    std::uint32_t point, small;
};
// Greek letters with accents, and the other small sigma.
constexpr SmallLetter greek_letters[] = {
    {0x386, 0x3b1}, {0x388, 0x3b5}, {0x389, 0x3b7}, {0x38a, 0x3b9}, {0x38c, 0x3bf}, {0x38e, 0x3c5},
    {0x38f, 0x3c9}, {0x390, 0x3b9}, {0x3aa, 0x3b9}, {0x3ab, 0x3c5}, {0x3ac, 0x3b1}, {0x3ad, 0x3b5},
    {0x3ae, 0x3b7}, {0x3af, 0x3b9}, {0x3b0, 0x3c5}, {0x3c2, 0x3c3}, {0x3ca, 0x3b9}, {0x3cb, 0x3c5},
    {0x3cc, 0x3bf}, {0x3cd, 0x3c5}, {0x3ce, 0x3c9},
};

// One code point of UTF-8; a byte that is none counts as itself.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
    const auto byte = [&](std::size_t i) { return std::uint8_t(text[i]); };
    const std::uint8_t first = byte(at++);
    const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    if (first < 0x80 || more == 0 || at + std::size_t(more) > text.size())
        return first;
    std::uint32_t point = first & (0x3fu >> more);
    for (int i = 0; i < more; ++i)
        point = point << 6 | (byte(at++) & 0x3f);
    return point;
}

bool has_two_letters(std::uint32_t point) {
    constexpr std::uint32_t umlauts[] = {0xc4, 0xd6, 0xdc, 0xe4, 0xf6, 0xfc,  0xc5,
                                         0xe5, 0xc6, 0xe6, 0xd8, 0xf8, 0x152, 0x153};
    return std::find(std::begin(umlauts), std::end(umlauts), point) != std::end(umlauts);
}

enum class Kind { other, digit, small, capital };

Kind kind_of(std::uint32_t point) {
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

bool is_accent(std::uint32_t point) {
    return point >= 0x300 && point < 0x370;
}

// Blank: the letter has none.
char basic_letter_of(std::uint32_t point) {
    if (point >= 0x1e00 && point < 0x1f00)
        return additional_letters[point - 0x1e00];
    for (const BasicLetter& letter : single_letters)
        if (letter.point == point)
            return letter.basic;
    return basic_letter(point);
}

// Greek and Cyrillic; the same code point for other letters.
std::uint32_t small_letter(std::uint32_t point) {
    for (const SmallLetter& letter : greek_letters)
        if (letter.point == point)
            return letter.small;
    constexpr std::uint32_t io = 0x401, small_io = 0x451, small_ie = 0x435;  // both written as "е"
    if (point == io || point == small_io)
        return small_ie;
    if ((point >= 0x391 && point < 0x3aa) || (point >= 0x410 && point < 0x430))
        return point + 0x20;
    return point >= 0x400 && point < 0x410 ? point + 0x50 : point;
}

// A letter or digit in small basic letters. Empty: a separator.
std::string folded(std::uint32_t point, std::string_view bytes, Umlaut umlaut) {
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
    if (point >= 0x370 && point < 0x460) {
        const std::uint32_t small = small_letter(point);
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
        const std::size_t begin = at;
        const std::uint32_t point = next_code_point(text, at);
        // An accent that follows its letter, as some systems write file names.
        if (is_accent(point)) {
            if (point == 0x308 && umlaut == Umlaut::as_two_letters)
                words.back() += 'e';
            continue;
        }
        const std::string letters = folded(point, text.substr(begin, at - begin), umlaut);
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
