// SPDX-License-Identifier: Apache-2.0
#include "cases/dicom_text.h"

#include <iconv.h>

#include <array>
#include <optional>
#include <utility>

namespace theatron::cases {
namespace {

// Sets of one byte, and of several without escape sequences.
constexpr std::array<std::pair<std::string_view, const char*>, 14> encodings = {{
    {"ISO_IR 192", "UTF-8"},
    {"ISO_IR 100", "ISO-8859-1"},
    {"ISO_IR 101", "ISO-8859-2"},
    {"ISO_IR 109", "ISO-8859-3"},
    {"ISO_IR 110", "ISO-8859-4"},
    {"ISO_IR 144", "ISO-8859-5"},
    {"ISO_IR 127", "ISO-8859-6"},
    {"ISO_IR 126", "ISO-8859-7"},
    {"ISO_IR 138", "ISO-8859-8"},
    {"ISO_IR 148", "ISO-8859-9"},
    {"ISO_IR 203", "ISO-8859-15"},
    {"ISO_IR 166", "TIS-620"},
    {"GB18030", "GB18030"},
    {"ISO_IR 13", "SHIFT_JIS"},
}};

std::string first_value(std::string_view charset) {
    std::string value(charset.substr(0, charset.find('\\')));
    while (!value.empty() && value.back() == ' ')
        value.pop_back();
    // The same sets, with escape sequences for others.
    constexpr std::string_view extensible = "ISO 2022 IR ";
    if (value.starts_with(extensible))
        value = "ISO_IR " + value.substr(extensible.size());
    return value == "GBK" ? "GB18030" : value;
}

std::optional<std::string> convert(std::string_view text, const char* from) {
    iconv_t converter = iconv_open("UTF-8", from);
    if (converter == iconv_t(-1))
        return std::nullopt;
    std::string in(text), out(4 * text.size(), '\0');
    char *read = in.data(), *write = out.data();
    std::size_t to_read = in.size(), room = out.size();
    const bool converted =
        iconv(converter, &read, &to_read, &write, &room) != std::size_t(-1) && to_read == 0;
    iconv_close(converter);
    if (!converted)
        return std::nullopt;
    out.resize(out.size() - room);
    return out;
}

constexpr char escape = '\x1b';

// `text` without the escape sequence, which says only what its bytes from 0x80 on are.
std::string without(std::string_view sequence, std::string_view text) {
    std::string rest(text);
    for (std::size_t at; (at = rest.find(sequence)) != std::string::npos;)
        rest.erase(at, sequence.size());
    return rest;
}

// Half-width katakana, bytes of ISO_IR 13, as the escape sequences that iconv knows.
std::string with_escaped_katakana(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0xa1 && byte <= 0xdf)
            escaped += std::string("\x1b(I") + char(byte - 0x80) + "\x1b(J";
        else
            escaped += c;
    }
    return escaped;
}

// Texts with code extensions (PS3.5, 6.1.2.5): Japanese, Korean, Chinese.
std::optional<std::string> convert_extended(std::string_view text) {
    constexpr std::string_view korean = "\x1b$)C", chinese = "\x1b$)A";
    if (text.find(korean) != std::string_view::npos)
        return convert(without(korean, text), "EUC-KR");
    if (text.find(chinese) != std::string_view::npos)
        return convert(without(chinese, text), "EUC-CN");
    return convert(with_escaped_katakana(text), "ISO-2022-JP-3");
}

}  // namespace

std::string utf8_of_dicom(std::string_view text, std::string_view charset) {
    if (text.find(escape) != std::string_view::npos)
        if (auto converted = convert_extended(text))
            return *std::move(converted);
    const std::string said = first_value(charset);
    for (const auto& [name, encoding] : encodings)
        if (said == name)
            if (auto converted = convert(text, encoding))
                return *std::move(converted);
    if (auto same = convert(text, "UTF-8"))
        return *std::move(same);
    return convert(text, "ISO-8859-1").value_or("");
}

}  // namespace theatron::cases
