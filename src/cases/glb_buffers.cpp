// SPDX-License-Identifier: Apache-2.0
#include "cases/glb_buffers.h"

#include <algorithm>
#include <array>
#include <utility>

namespace theatron::cases::glb {
namespace {

constexpr std::uint8_t no_digit = 0xff;

constexpr std::array<std::uint8_t, 256> base64_digits = [] {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> values{};
    values.fill(no_digit);
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[std::uint8_t(digits[i])] = std::uint8_t(i);
    return values;
}();

int hexadecimal(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

}  // namespace

std::optional<Bytes> bytes_of_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == uri.npos ||
        !uri.substr(0, comma).ends_with(";base64"))
        return std::nullopt;
    std::string_view text = uri.substr(comma + 1);
    while (text.ends_with('='))
        text.remove_suffix(1);
    Bytes out;
    out.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::uint8_t digit = base64_digits[std::uint8_t(c)];
        if (digit == no_digit)
            return std::nullopt;
        bits = bits << 6 | digit;
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(std::byte(bits >> count & 0xff));
        }
    }
    // A single digit at the end is less than a byte.
    return text.size() % 4 == 1 ? std::nullopt : std::optional(std::move(out));
}

std::string name_of_uri(std::string_view uri) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : -1;
        const int low = high >= 0 ? hexadecimal(uri[i + 2]) : -1;
        name += low >= 0 ? char(high * 16 + low) : uri[i];
        i += low >= 0 ? 2 : 0;
    }
    return name.starts_with("./") ? name.substr(2) : name;
}

Answer Buffers::find(std::size_t number, ByteView& out) {
    const Json& buffers = list_of(root_, "buffers");
    const bool is_own =
        number == 0 && (buffers.empty() || !buffers[0].is_object() || !buffers[0].contains("uri"));
    if (is_own) {
        out = own_;
        return Answer::content;
    }
    if (number >= buffers.size())
        return Answer::unreadable;
    auto known = loaded_.find(number);
    if (known == loaded_.end()) {
        Bytes bytes;
        if (const Answer loaded = load(buffers[number], bytes); loaded != Answer::content)
            return loaded;
        known = loaded_.emplace(number, std::move(bytes)).first;
    }
    out = known->second;
    return Answer::content;
}

Answer Buffers::load(const Json& buffer, Bytes& out) {
    const std::string uri = text_of(buffer, "uri");
    if (uri.empty())
        return Answer::lacks;
    std::optional<Bytes> bytes;
    if (uri.starts_with("data:")) {
        bytes = bytes_of_data_uri(uri);
        said_ = "uri";
    } else {
        const std::string name = name_of_uri(uri);
        bytes = find_beside_ ? find_beside_(name) : std::nullopt;
        said_ = name;
    }
    if (!bytes)
        return uri.starts_with("data:") ? Answer::property : Answer::other_buffer;
    said_.clear();
    out = std::move(*bytes);
    return Answer::content;
}

}  // namespace theatron::cases::glb
