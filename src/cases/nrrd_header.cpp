// SPDX-License-Identifier: Apache-2.0
#include "cases/nrrd_header.h"

#include <algorithm>

#include "base/outside_text.h"
#include "base/small_letters.h"
#include "base/trimmed.h"
#include "cases/text_words.h"

namespace theatron::cases::nrrd {
namespace {

constexpr std::size_t max_header_bytes = 1 << 20;
constexpr std::size_t max_fields = 8192;

}  // namespace

std::optional<Header> read_header(ByteView file) {
    Header header;
    Fields& fields = header.fields;
    const std::string_view text(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), max_header_bytes));
    if (!text.starts_with("NRRD000"))
        return std::nullopt;
    std::size_t at = text.find('\n');
    while (at != std::string_view::npos && fields.size() < max_fields) {
        const std::size_t begin = at + 1, end = std::min(text.find('\n', begin), text.size());
        if (begin >= text.size()) {
            // A header with its samples in another file needs no empty line at its end.
            const bool is_whole = fields.contains("data file") && text.size() < max_header_bytes;
            if (!is_whole)
                return std::nullopt;
            header.content = text.size();
            return header;
        }
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        at = end;
        if (line.empty()) {
            header.content = std::min(end + 1, text.size());
            return header;
        }
        if (line[0] == '#')
            continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon + 1 == line.size())
            continue;
        const bool is_key = line[colon + 1] == '=';
        const std::string_view name = trimmed(line.substr(0, colon)),
                               value = trimmed(line.substr(colon + (is_key ? 2 : 1)));
        std::string known = is_key ? std::string(name) : in_small_letters(name);
        if (known == "datafile")
            known = "data file";
        if (known == "lineskip" || known == "byteskip")
            known.insert(4, " ");
        const auto [place, is_new] = fields.emplace(std::move(known), value);
        if (!is_new && !is_key && place->second != value)
            header.repeated = place->first;
    }
    return std::nullopt;
}

std::string field(const Fields& fields, std::string_view name) {
    const auto found = fields.find(name);
    return found == fields.end() ? "" : found->second;
}

std::optional<long> whole_number(std::string_view text) {
    long number = 0;
    return to_number(trimmed(text), number) ? std::optional(number) : std::nullopt;
}

std::string bad_field(const Fields& fields, const std::string& name, const char* wanted) {
    return "has the field '" + name + "' with '" + clean_text(field(fields, name), 60) +
           "', which is no " + wanted + "; export it again";
}

}  // namespace theatron::cases::nrrd
