// SPDX-License-Identifier: Apache-2.0
#include "cases/patient_words.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace theatron::cases {
namespace {

constexpr std::size_t least_anywhere = 3, least_as_word = 2;

// Basic letters of U+00C0 to U+017F; blank: none.
constexpr std::string_view basic_letters =
    "aaaaaaaceeeeiiiidnooooo ouuuuyts"
    "aaaaaaaceeeeiiiidnooooo ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggg"
    "gggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssss"
    "ssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
static_assert(basic_letters.size() == 0x180 - 0xc0);

// How umlauts and their like become ASCII: "Müller" is "muller" or "mueller".
enum class Umlaut { as_one_letter, as_two_letters };

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
    constexpr std::uint32_t umlauts[] = {0xc4, 0xd6, 0xdc, 0xe4, 0xf6, 0xfc,
                                         0xc5, 0xe5, 0xc6, 0xe6, 0xd8, 0xf8};
    return std::find(std::begin(umlauts), std::end(umlauts), point) != std::end(umlauts);
}

// The words of a text in small basic letters and digits; letters of other scripts stay.
std::vector<std::string> folded_words(std::string_view text, Umlaut umlaut) {
    std::vector<std::string> words(1);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        const std::uint32_t point = next_code_point(text, at);
        std::string& word = words.back();
        if ((point >= '0' && point <= '9') || (point >= 'a' && point <= 'z')) {
            word += char(point);
        } else if (point >= 'A' && point <= 'Z') {
            word += char(point - 'A' + 'a');
        } else if (point >= 0xc0 && point < 0x180 && basic_letters[point - 0xc0] != ' ') {
            word += basic_letters[point - 0xc0];
            if (point == 0xdf)
                word += 's';
            else if (umlaut == Umlaut::as_two_letters && has_two_letters(point))
                word += point == 0xc5 || point == 0xe5 ? 'a' : 'e';
        } else if (point == 0x300 || (point > 0x300 && point < 0x370)) {
            // An accent that follows its letter, as some systems write file names.
            if (point == 0x308 && umlaut == Umlaut::as_two_letters)
                word += 'e';
        } else if (point >= 0x180 && point != 0x2013 && point != 0x2014 && point != 0x3000) {
            word += text.substr(begin, at - begin);
        } else if (!word.empty()) {
            words.emplace_back();
        }
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

}  // namespace

void PatientWords::add_word(std::string word, bool is_name) {
    if (word.size() >= least_anywhere)
        words_.push_back(std::move(word));
    else if (is_name && word.size() >= least_as_word)
        short_words_.push_back(std::move(word));
}

// `text`: one or several values, parted by backslashes.
void PatientWords::add_text(const std::string& text, bool is_name) {
    for (const Umlaut umlaut : {Umlaut::as_one_letter, Umlaut::as_two_letters})
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\\', at), text.size());
            const auto words = folded_words(std::string_view(text).substr(at, end - at), umlaut);
            at = end + 1;
            // A number counts as a whole: its parts are in many texts.
            if (!is_name)
                add_word(joined(words), false);
            else
                for (const std::string& word : words)
                    add_word(word, true);
        }
}

void PatientWords::add(const Identifier& identifier) {
    const std::string& value = identifier.value;
    if (identifier.name == "PatientName" || identifier.name == "OtherPatientNames") {
        add_text(value, true);
    } else if (identifier.name == "PatientID" || identifier.name == "OtherPatientIDs" ||
               identifier.name == "AccessionNumber") {
        add_text(value, false);
    } else if (identifier.name == "PatientBirthDate" && value.size() == 8) {
        const std::string year = value.substr(0, 4), month = value.substr(4, 2),
                          day = value.substr(6, 2);
        for (const std::string& date : {year + month + day, day + month + year, month + day + year,
                                        year.substr(2) + month + day, day + month + year.substr(2)})
            add_word(date, false);
    }
}

bool PatientWords::occur_in(const std::string& text) const {
    for (const Umlaut umlaut : {Umlaut::as_one_letter, Umlaut::as_two_letters}) {
        const std::vector<std::string> words = folded_words(text, umlaut);
        const std::string all = joined(words);
        for (const std::string& word : words_)
            if (all.find(word) != std::string::npos)
                return true;
        for (const std::string& word : short_words_)
            if (std::find(words.begin(), words.end(), word) != words.end())
                return true;
    }
    return false;
}

}  // namespace theatron::cases
