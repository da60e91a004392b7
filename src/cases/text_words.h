// SPDX-License-Identifier: Apache-2.0
// Words and numbers of text files, whatever parts lines in them. Safe for any bytes.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "base/small_letters.h"

namespace theatron::cases {

// Without regard to case; `lower` is in small letters.
inline bool is_word(std::string_view word, std::string_view lower) {
    return equal_without_case(word, lower);
}

// The whole word as a number; a comma may stand for the point.
template <class T>
bool to_number(std::string_view word, T& out) {
    char text[64];
    if (word.starts_with('+'))
        word.remove_prefix(1);
    if (word.empty() || word.size() > sizeof(text))
        return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        text[i] = word[i] == ',' ? '.' : word[i];
    const auto [end, error] = std::from_chars(text, text + word.size(), out);
    return error == std::errc() && end == text + word.size();
}

class TextWords {
public:
    explicit TextWords(ByteView bytes)
        : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {
        if (text_.starts_with("\xef\xbb\xbf"))
            at_ = 3;
    }

    // Empty at the end.
    std::string_view next() {
        while (at_ < text_.size() && is_blank(text_[at_]))
            ++at_;
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string rest_of_line() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r')
            ++at_;
        std::string_view line = text_.substr(begin, at_ - begin);
        while (!line.empty() && is_blank(line.front()))
            line.remove_prefix(1);
        while (!line.empty() && is_blank(line.back()))
            line.remove_suffix(1);
        return std::string(line);
    }
    // Moves behind the next end of a line: LF, CR LF or CR.
    void skip_line() {
        rest_of_line();
        if (at_ < text_.size() && text_[at_++] == '\r' && at_ < text_.size() && text_[at_] == '\n')
            ++at_;
    }
    bool at_end() const { return at_ >= text_.size(); }
    std::size_t place() const { return at_; }

private:
    static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
    }
    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace theatron::cases
