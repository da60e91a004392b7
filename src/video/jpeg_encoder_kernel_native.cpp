// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_encoder_kernel_native.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "video/jpeg_encoder_tile.h"
#include "video/jpeg_zigzag.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "video/jpeg_encoder_kernel_native.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "video/jpeg_encoder_transform-inl.h"

#ifndef THEATRON_JPEG_ENCODER_KERNEL_SHARED
#define THEATRON_JPEG_ENCODER_KERNEL_SHARED
namespace theatron::video::jpeg {

// Where the k-th coefficient of a block lies.
constexpr auto place_of = [] {
    std::array<std::uint16_t, 64> place{};
    for (std::size_t k = 0; k < 64; ++k)
        place[k] = std::uint16_t(jpeg_zigzag[k] % 8 * tile_width + jpeg_zigzag[k] / 8);
    return place;
}();

// The bytes of BlockRow::nonzero as sets of k.
constexpr auto in_zigzag = [] {
    std::array<std::array<std::uint64_t, 256>, 8> sets{};
    for (std::size_t k = 0; k < 64; ++k)
        for (unsigned byte = 0; byte < 256; ++byte)
            if (byte >> (jpeg_zigzag[k] / 8) & 1)
                sets[jpeg_zigzag[k] % 8][byte] |= std::uint64_t(1) << k;
    return sets;
}();

constexpr int size_of(int value) {
    return int(std::bit_width(unsigned(value < 0 ? -value : value)));
}

constexpr Code code_of(const HuffmanCodes& codes, int symbol, int size) {
    return Code(codes.bits[symbol]) << (size + 5) | Code(codes.length[symbol] + size);
}

// Negative values are written less 1, in as many bits as their magnitude has.
constexpr Code with_value(Code code, int value, int size) {
    return code | (unsigned(value < 0 ? value - 1 : value) & ((1u << size) - 1)) << 5;
}

constexpr CodeTables make_codes(int kind) {
    const HuffmanCodes dc = codes_of(dc_tables[kind]), ac = codes_of(ac_tables[kind]);
    CodeTables tables{};
    for (int size = 0; size < 12; ++size)
        tables.dc[size] = code_of(dc, size, size);
    for (int zeros = 0; zeros < 16; ++zeros) {
        for (int size = 1; size < 11; ++size)
            tables.ac[zeros][size] = code_of(ac, zeros << 4 | size, size);
        for (int value = -CodeTables::small; value < CodeTables::small; ++value)
            if (value != 0)
                tables.small_ac[zeros][value + CodeTables::small] =
                    with_value(tables.ac[zeros][size_of(value)], value, size_of(value));
    }
    tables.end_of_block = code_of(ac, end_of_block, 0);
    tables.sixteen_zeros = code_of(ac, sixteen_zeros, 0);
    return tables;
}

constexpr CodeTables codes[2] = {make_codes(0), make_codes(1)};

}  // namespace theatron::video::jpeg
#endif

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg::HWY_NAMESPACE {
// From coefficients to bits.

// Writes eight bytes at a time, of which only the full ones count.
class BitWriter {
public:
    explicit BitWriter(std::uint8_t* out) : out_(out) {}

    // At most 57 bits between flushes.
    HWY_INLINE void put(Code code) {
        const unsigned length = code & 31;
        bits_ = bits_ << length | code >> 5;
        count_ += length;
    }
    HWY_INLINE void flush() {
        const std::uint64_t bytes = __builtin_bswap64(bits_ << (64 - count_));
        std::memcpy(out_, &bytes, sizeof(bytes));
        out_ += count_ / 8;
        count_ %= 8;
    }
    unsigned count() const { return count_; }
    std::uint8_t* out() const { return out_; }
    void restart(std::uint8_t* out) { out_ = out; }

private:
    std::uint8_t* out_;
    std::uint64_t bits_ = 0;  // the lowest `count_` are still to be written
    unsigned count_ = 0;
};

HWY_INLINE void code_block(const BlockRow& row, int block, const CodeTables& tables, int& previous,
                           BitWriter& out) {
    std::uint64_t coded = 0;
    for (std::size_t column = 0; column < 8; ++column)
        coded |= in_zigzag[column][row.nonzero[column][block]];
    const std::int16_t* const values = row.values[0] + 8 * block;

    const int change = values[0] - previous;
    previous = values[0];
    const int size = size_of(change);
    out.put(with_value(tables.dc[size], change, size));
    out.flush();

    const bool ends_early = coded >> 63 == 0;
    int last = 0;
    for (coded &= ~std::uint64_t(1); coded != 0; coded &= coded - 1) {
        const int k = std::countr_zero(coded);
        int zeros = k - last - 1;
        last = k;
        for (; zeros > 15; zeros -= 16) {
            out.put(tables.sixteen_zeros);
            out.flush();
        }
        const int value = values[place_of[std::size_t(k)]];
        const unsigned index = unsigned(value + CodeTables::small);
        if (index < 2 * CodeTables::small) {
            out.put(tables.small_ac[zeros][index]);
        } else {
            const int bits = size_of(value);
            out.put(with_value(tables.ac[zeros][bits], value, bits));
        }
        out.flush();
    }
    if (ends_early) {
        out.put(tables.end_of_block);
        out.flush();
    }
}

// Copies [from, end) with a zero after each 0xff, which otherwise begins a marker.
HWY_INLINE std::uint8_t* stuff(const std::uint8_t* from, const std::uint8_t* end,
                               std::uint8_t* out) {
    while (end - from >= 8) {
        std::uint64_t bytes;
        std::memcpy(&bytes, from, sizeof(bytes));
        std::memcpy(out, &bytes, sizeof(bytes));
        constexpr std::uint64_t low_bits = 0x0101010101010101;
        if ((bytes & (~bytes - low_bits) & low_bits << 7) == 0) {
            from += 8;
            out += 8;
            continue;
        }
        for (int i = 0; i < 8; ++i) {
            *out++ = *from;
            if (*from++ == 0xff)
                *out++ = 0;
        }
    }
    while (from != end) {
        *out++ = *from;
        if (*from++ == 0xff)
            *out++ = 0;
    }
    return out;
}

// The rows of a tile at (x, y), repeating the last pixels beyond the picture.
class TileRows {
public:
    TileRows(ColorView image) : image_(image) {}

    // `index` tells rows apart that are used at the same time.
    HWY_INLINE const std::uint8_t* get(int x, int y, int index) {
        const auto [width, height] = image_.size;
        const Rgb* const row = image_.row(std::min(y, height - 1)) + x;
        if (x + tile_width <= width)
            return &row->r;
        Rgb* const copy = copies_[index];
        const int left = width - x;
        std::copy_n(row, left, copy);
        std::fill(copy + left, copy + tile_width, row[left - 1]);
        return &copy->r;
    }

private:
    ColorView image_;
    Rgb copies_[2][tile_width];
};

std::uint8_t* encode_scan(ColorView image, bool halve_chroma, const ScanTables& tables,
                          std::uint8_t* row_buffer, std::uint8_t* out) {
    const auto [width, height] = image.size;
    const int unit = halve_chroma ? 16 : 8;
    const auto& factor = tables.factor;
    const auto& scale = tables.scale;
    TileRows rows(image);
    BlockRow y0, y1, cb, cr;
    int previous_y = 0, previous_cb = 0, previous_cr = 0;
    BitWriter bits(row_buffer);
    for (int y = 0; y < height; y += unit) {
        for (int x = 0; x < width; x += tile_width) {
            if (halve_chroma) {
                for (int i = 0; i < 8; ++i) {
                    BlockRow& to = i < 4 ? y0 : y1;
                    convert_halved(rows.get(x, y + 2 * i, 0), rows.get(x, y + 2 * i + 1, 1),
                                   to.values[2 * i % 8], to.values[2 * i % 8 + 1], cb.values[i],
                                   cr.values[i]);
                }
                transform_row<true>(y1, tile_width, factor[0], scale[0]);
            } else {
                for (int i = 0; i < 8; ++i)
                    convert(rows.get(x, y + i, 0), y0.values[i], cb.values[i], cr.values[i]);
            }
            transform_row<true>(y0, tile_width, factor[0], scale[0]);
            const int chroma_width = halve_chroma ? tile_width / 2 : tile_width;
            transform_row<false>(cb, chroma_width, factor[1], scale[1]);
            transform_row<false>(cr, chroma_width, factor[1], scale[1]);

            const int units = (std::min(width - x, tile_width) + unit - 1) / unit;
            for (int i = 0; i < units; ++i) {
                if (halve_chroma) {
                    const int left = widened_block(2 * i), right = widened_block(2 * i + 1);
                    code_block(y0, left, codes[0], previous_y, bits);
                    code_block(y0, right, codes[0], previous_y, bits);
                    code_block(y1, left, codes[0], previous_y, bits);
                    code_block(y1, right, codes[0], previous_y, bits);
                    code_block(cb, i, codes[1], previous_cb, bits);
                    code_block(cr, i, codes[1], previous_cr, bits);
                } else {
                    const int block = widened_block(i);
                    code_block(y0, block, codes[0], previous_y, bits);
                    code_block(cb, block, codes[1], previous_cb, bits);
                    code_block(cr, block, codes[1], previous_cr, bits);
                }
            }
        }
        if (y + unit >= height && bits.count() > 0) {
            // The last byte is filled up with ones.
            const unsigned missing = 8 - bits.count();
            bits.put(((1u << missing) - 1) << 5 | missing);
            bits.flush();
        }
        out = stuff(row_buffer, bits.out(), out);
        bits.restart(row_buffer);
    }
    return out;
}

}  // namespace theatron::video::jpeg::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::video::jpeg {

HWY_EXPORT(encode_scan);

ScanTables::ScanTables(int quality) {
    for (int kind = 0; kind < 2; ++kind)
        for (int i = 0; i < 64; ++i) {
            const Divisor by = divisor_of(step_at(standard_steps[kind][i], quality));
            const int at = i % 8 * 8 + i / 8;
            factor[kind][at] = by.factor;
            scale[kind][at] = by.scale;
        }
}

std::size_t max_row_size(int width, bool halve_chroma) {
    constexpr std::size_t max_block = 64 * 26 / 8;
    const std::size_t blocks = halve_chroma ? std::size_t(width + 15) / 16 * 6  //
                                            : std::size_t(width + 7) / 8 * 3;
    return blocks * max_block + 2 * sizeof(std::uint64_t);
}

std::size_t max_scan_size(Size size, bool halve_chroma) {
    const std::size_t rows = std::size_t(halve_chroma ? (size.height + 15) / 16  //
                                                      : (size.height + 7) / 8);
    return rows * 2 * max_row_size(size.width, halve_chroma);
}

std::uint8_t* encode_scan(ColorView image, bool halve_chroma, const ScanTables& tables,
                          std::uint8_t* row_buffer, std::uint8_t* out) {
    return HWY_DYNAMIC_DISPATCH(encode_scan)(image, halve_chroma, tables, row_buffer, out);
}

}  // namespace theatron::video::jpeg
#endif
