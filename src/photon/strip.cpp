// SPDX-License-Identifier: Apache-2.0
#include "photon/strip.h"

#include <bit>
#include <cstdlib>

namespace theatron::photon {
namespace {

constexpr int time_bits = 16;
constexpr unsigned time_mask = (1u << time_bits) - 1;

constexpr unsigned gray_of(unsigned value) {
    return value ^ (value >> 1);
}

constexpr unsigned from_gray(unsigned gray) {
    for (int shift = 1; shift < time_bits; shift *= 2)
        gray ^= gray >> shift;
    return gray;
}
static_assert(from_gray(gray_of(0xfedc)) == 0xfedc);

// CRC-6 (x^6 + x + 1): differs for any two times that differ in one or two cells.
constexpr unsigned crc_of(unsigned bits) {
    unsigned crc = 0x3f;
    for (int i = time_bits - 1; i >= 0; --i) {
        const unsigned top = (crc >> 5 ^ bits >> i) & 1;
        crc = (crc << 1 ^ (top ? 0x03u : 0u)) & 0x3f;
    }
    return crc;
}

// Six bits that are no linear function of the others, as those of a CRC are: a mixture of two times
// is then known by them, too (the finalizer of MurmurHash3, shortened).
constexpr unsigned hash_of(unsigned bits) {
    std::uint32_t hash = bits * 0x85ebca6bu;
    hash ^= hash >> 13;
    hash *= 0xc2b2ae35u;
    return hash >> 26;
}

constexpr unsigned check_of(unsigned bits) {
    return crc_of(bits) | hash_of(bits) << 6;
}

std::size_t index_of(int column, int row) {
    return std::size_t(row * strip_columns + column);
}

// Calls `use(cell, bit number)` for all cells that are not fixed: bits of the time first.
template <class Use>
void for_each_bit(Use use) {
    int bit = 0;
    for (int row = 0; row < strip_rows; ++row)
        for (int column = 0; column < strip_columns; ++column)
            if (!fixed_cell(column, row))
                use(index_of(column, row), bit++);
}

unsigned bits_of(const StripCells& cells) {
    unsigned bits = 0;
    for_each_bit([&](std::size_t cell, int bit) { bits |= unsigned(cells[cell]) << bit; });
    return bits;
}

unsigned with_check(unsigned gray) {
    return gray | check_of(gray) << time_bits;
}

StripTime time_of_gray(unsigned gray) {
    return StripTime(from_gray(gray));
}

}  // namespace

std::optional<bool> fixed_cell(int column, int row) {
    // Turned by half a turn, each of them has the other colour.
    constexpr int middle = strip_columns / 2;
    if (column == 0)
        return row != 1;
    if (column == strip_columns - 1)
        return row == 1;
    if (row == 1 && (column == middle - 1 || column == middle))
        return column != middle;
    return std::nullopt;
}

StripCells cells_of(StripTime time) {
    const unsigned bits = with_check(gray_of(time));
    StripCells cells{};
    for (int row = 0; row < strip_rows; ++row)
        for (int column = 0; column < strip_columns; ++column)
            cells[index_of(column, row)] = fixed_cell(column, row).value_or(false);
    for_each_bit([&](std::size_t cell, int bit) { cells[cell] = bits >> bit & 1; });
    return cells;
}

std::optional<StripTime> time_of(const StripCells& cells) {
    const StripTime time = time_of_gray(bits_of(cells) & time_mask);
    return cells_of(time) == cells ? std::optional(time) : std::nullopt;
}

std::optional<ChangingTimes> changing_times_of(const StripCells& cells,
                                               const StripCells& is_changing) {
    constexpr int most_changing = 10, longest_change_ms = 100;
    const unsigned changing = bits_of(is_changing);
    const unsigned changing_time = changing & time_mask;
    if (changing_time == 0 || std::popcount(changing_time) > most_changing)
        return std::nullopt;
    const unsigned known = bits_of(cells) & ~changing;
    std::optional<ChangingTimes> result;
    // All subsets of the changing bits, each once with its complement.
    const unsigned last = std::bit_floor(changing_time);
    for (unsigned chosen = changing_time & ~last;; chosen = (chosen - 1) & changing_time & ~last) {
        const unsigned one = with_check((known & time_mask) | chosen);
        const unsigned other = with_check((known & time_mask) | (changing_time & ~chosen));
        const int apart =
            difference_ms(time_of_gray(other & time_mask), time_of_gray(one & time_mask));
        if ((one ^ other) == changing && (one & ~changing) == known &&
            std::abs(apart) <= longest_change_ms) {
            if (result)
                return std::nullopt;
            const StripTime a = time_of_gray(one & time_mask), b = time_of_gray(other & time_mask);
            result = apart > 0 ? ChangingTimes{a, b} : ChangingTimes{b, a};
        }
        if (chosen == 0)
            return result;
    }
}

bool is_white(const StripCells& cells, double x, double y) {
    const bool in_frame = x >= 1 && x < strip_width - 1 && y >= 1 && y < strip_height - 1;
    if (!in_frame)
        return true;
    const bool in_cells = x >= 2 && x < strip_width - 2 && y >= 2 && y < strip_height - 2;
    return in_cells && cells[index_of(int(x) - 2, int(y) - 2)];
}

void draw_strip(StripTime time, MutableColorView out) {
    const StripCells cells = cells_of(time);
    for (int y = 0; y < out.size.height; ++y)
        for (int x = 0; x < out.size.width; ++x) {
            const bool white = is_white(cells, (x + 0.5) * strip_width / out.size.width,
                                        (y + 0.5) * strip_height / out.size.height);
            out.row(y)[x] = white ? Rgb{255, 255, 255} : Rgb{};
        }
}

}  // namespace theatron::photon
