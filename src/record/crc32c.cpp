// SPDX-License-Identifier: Apache-2.0
#include "record/crc32c.h"

#include <array>

namespace theatron::record {
namespace {

constexpr std::uint32_t polynomial = 0x82f63b78;  // 0x1edc6f41 with its bits reversed
constexpr std::size_t step = 8;                   // bytes a turn

using Tables = std::array<std::array<std::uint32_t, 256>, step>;

// Table k: the change of the remainder by a byte that k more bytes follow.
constexpr Tables make_tables() {
    Tables tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t remainder = i;
        for (int bit = 0; bit < 8; ++bit)
            remainder = remainder >> 1 ^ (remainder & 1 ? polynomial : 0);
        tables[0][i] = remainder;
    }
    for (std::size_t k = 1; k < step; ++k)
        for (std::size_t i = 0; i < 256; ++i)
            tables[k][i] = tables[k - 1][i] >> 8 ^ tables[0][tables[k - 1][i] & 0xff];
    return tables;
}

constexpr Tables tables = make_tables();

std::uint32_t by_tables(ByteView bytes, std::uint32_t remainder) {
    for (; bytes.size() >= step; bytes = bytes.subspan(step)) {
        const std::uint64_t next = load_le<std::uint64_t>(bytes.data()) ^ remainder;
        remainder = 0;
        for (std::size_t i = 0; i < step; ++i)
            remainder ^= tables[step - 1 - i][next >> (8 * i) & 0xff];
    }
    for (const std::byte b : bytes)
        remainder = remainder >> 8 ^ tables[0][(remainder ^ std::to_integer<unsigned>(b)) & 0xff];
    return remainder;
}

#if defined(__x86_64__)
__attribute__((target("sse4.2"))) std::uint32_t by_instruction(ByteView bytes,
                                                               std::uint32_t remainder) {
    std::uint64_t wide = remainder;
    for (; bytes.size() >= step; bytes = bytes.subspan(step))
        wide = __builtin_ia32_crc32di(wide, load_le<std::uint64_t>(bytes.data()));
    remainder = std::uint32_t(wide);
    for (const std::byte b : bytes)
        remainder = __builtin_ia32_crc32qi(remainder, std::to_integer<unsigned char>(b));
    return remainder;
}
#endif

}  // namespace

std::uint32_t crc32c(ByteView bytes, std::uint32_t before) {
#if defined(__x86_64__)
    static const bool has_instruction = __builtin_cpu_supports("sse4.2");
    if (has_instruction)
        return ~by_instruction(bytes, ~before);
#endif
    return ~by_tables(bytes, ~before);
}

std::uint32_t crc32c_reference(ByteView bytes, std::uint32_t before) {
    std::uint32_t remainder = ~before;
    for (const std::byte b : bytes) {
        remainder ^= std::to_integer<std::uint32_t>(b);
        for (int bit = 0; bit < 8; ++bit)
            remainder = remainder >> 1 ^ (remainder & 1 ? polynomial : 0);
    }
    return ~remainder;
}

}  // namespace theatron::record
