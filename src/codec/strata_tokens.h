// SPDX-License-Identifier: Apache-2.0
// The alphabet of Strata: one token per pixel.
//
// A token states that the pixel has no measurement, or gives its difference to the
// prediction. Small differences have a token each; a token of a larger difference is
// followed by its low bits, uncompressed.
#pragma once

#include <cstdint>

namespace theatron::codec::strata {

inline constexpr unsigned token_count = 64;       // table stride per context; fewer are in use
inline constexpr unsigned hole_token = 0;         // depth 0
inline constexpr unsigned top_token = 1;          // depth 65535
inline constexpr unsigned literal_low_token = 2;  // the depth itself, in 15 bits
inline constexpr unsigned first_token = 3;        // zigzagged difference 0
inline constexpr unsigned direct_tokens = 24;
inline constexpr unsigned first_long_token = first_token + direct_tokens;
inline constexpr unsigned literal_high_token = first_long_token + 23;  // 32768 + 15 bits
inline constexpr unsigned used_tokens = literal_high_token + 1;

// Maps 0, -1, 1, -2, … to 0, 1, 2, 3, … and back.
constexpr std::uint16_t zigzag16(std::uint16_t difference) {
    return std::uint16_t((difference << 1) ^ (difference & 0x8000 ? 0xffff : 0));
}
constexpr std::uint16_t unzigzag16(std::uint16_t code) {
    return std::uint16_t((code >> 1) ^ (code & 1 ? 0xffff : 0));
}

// The number of further bits of a token.
constexpr unsigned extra_bits(unsigned token) {
    if (token == literal_low_token || token == literal_high_token)
        return 15;
    return token < first_long_token ? 0 : (token - first_long_token + 9) / 2 - 1;
}

struct Token {
    unsigned token;
    unsigned extra;
};

// The token and further bits of a zigzagged difference, and back.
constexpr Token token_of(std::uint16_t code) {
    if (code < direct_tokens)
        return {first_token + code, 0};
    unsigned top = 4;
    while (code >> (top + 1) != 0)
        ++top;
    const unsigned second = code >> (top - 1) & 1;
    return {first_long_token + 2 * top + second - 9, code & ((1u << (top - 1)) - 1)};
}

constexpr std::uint16_t code_of(unsigned token, unsigned extra) {
    if (token < first_long_token)
        return std::uint16_t(token - first_token);
    const unsigned half = token - first_long_token + 9;
    return std::uint16_t(((2 | (half & 1)) << (half / 2 - 1)) | extra);
}

// The code of a token with further bits: the zigzagged difference, or the depth itself of a
// literal.
constexpr std::uint16_t long_code_of(unsigned token, unsigned extra) {
    if (token == literal_low_token || token == literal_high_token)
        return std::uint16_t((token == literal_high_token ? 0x8000 : 0) | extra);
    return code_of(token, extra);
}

static_assert(token_of(65535).token + 1 == literal_high_token);
static_assert(code_of(token_of(54321).token, token_of(54321).extra) == 54321);
static_assert(code_of(token_of(24).token, token_of(24).extra) == 24);

// Contexts. Pixels whose neighbours were all measured: ten levels of activity times
// three distances between the linear predictor and the prediction. Other pixels: one
// context per pattern of measured neighbours.
inline constexpr unsigned mixed_contexts = 30;
inline constexpr unsigned idle_context = 57;  // no pixel at this position
inline constexpr unsigned coded_contexts = 57;
inline constexpr unsigned context_count = 58;

// Lower bounds of the activity levels 1 to 9.
inline constexpr std::uint16_t activity_bounds[9] = {1, 2, 3, 6, 12, 24, 48, 96, 192};

}  // namespace theatron::codec::strata
