// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_encoder_kernel_native.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "video/jpeg_encoder_codes.h"
#include "video/jpeg_encoder_tile.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "video/jpeg_encoder_kernel_native.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "video/jpeg_encoder_transform-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg::HWY_NAMESPACE {

// Writes eight bytes at a time, of which only the full ones count.
class BitWriter {
public:
    explicit BitWriter(std::uint8_t* out) : out_(out) {}

    // At most 56 bits between flushes.
    HWY_INLINE void put(Code code) {
        bits_ = bits_ << (code & 63) | code >> 6;
        count_ += code;
    }
    HWY_INLINE void flush() {
        const std::uint64_t bytes = __builtin_bswap64(bits_ << (-count_ & 63));
        std::memcpy(out_, &bytes, sizeof(bytes));
        out_ += count_ / 8 & 7;
        count_ &= 7;
    }
    unsigned count() const { return count_; }
    std::uint8_t* out() const { return out_; }
    void restart(std::uint8_t* out) { out_ = out; }

private:
    std::uint8_t* out_;
    std::uint64_t bits_ = 0;  // the lowest are still to be written
    unsigned count_ = 0;      // how many of them, modulo 64
};

// A block's place in a tile. Luma has it in pixels, too.
struct Block {
    const std::int16_t* values;
    const std::uint8_t* nonzero;
    const CodeTables* codes;
    int* previous;  // the DC coefficient of the block before it
    int x, y;
};

HWY_INLINE Code code_of_value(const CodeTables& codes, std::size_t distance, std::ptrdiff_t value) {
    constexpr std::ptrdiff_t small = CodeTables::small;
    if (std::size_t(value + small) < 2 * small) [[likely]]
        return codes.by_value[distance][value + small];
    const int size = size_of(int(value));
    return with_value(codes.by_size[distance][size], int(value), size);
}

HWY_INLINE void code_block(const Block& block, BitWriter& writer) {
    BitWriter out = writer;
    const CodeTables& codes = *block.codes;
    std::uint64_t coded = 0;
    for (std::size_t column = 0; column < 8; ++column)
        coded |= in_zigzag[column][block.nonzero[column * tile_blocks]];
    const bool ends_early = coded >> 63 == 0;
    coded &= ~std::uint64_t(1);

    std::size_t last = 0;
    const auto put_next = [&]() HWY_ATTR {
        const auto k = std::size_t(std::countr_zero(coded));
        coded &= coded - 1;
        std::size_t distance = k - last;
        last = k;
        for (; distance > 16; distance -= 16) {
            out.put(codes.sixteen_zeros);
            out.flush();
        }
        out.put(code_of_value(codes, distance, block.values[place_of[k]]));
    };
    const std::ptrdiff_t dc = block.values[0];
    out.put(code_of_value(codes, 0, dc - *block.previous));
    *block.previous = int(dc);
    // There is room for two between flushes.
    while (coded != 0) {
        put_next();
        out.flush();
        if (coded == 0)
            break;
        put_next();
    }
    if (ends_early)
        out.put(codes.end_of_block);
    out.flush();
    writer = out;
}

// A block outside of the picture gets the DC of the block before, and no AC.
HWY_INLINE void skip_block(const Block& block, BitWriter& out) {
    out.put(code_of_value(*block.codes, 0, 0));
    out.put(block.codes->end_of_block);
    out.flush();
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

    // `index` is the number of the row among those that are used at the same time.
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

    // Starts loading the rows of a tile at (x, y). Processors foresee the next addresses of a few
    // long rows, but not of a tile's short ones.
    HWY_INLINE void fetch(int x, int y, int rows) const {
        constexpr int line = 64;  // bytes that one request loads, on most processors
        const auto [width, height] = image_.size;
        const int bytes = 3 * std::min(width - x, tile_width);
        for (const int end = std::min(y + rows, height); y < end; ++y)
            for (int i = 0; i < bytes; i += line)
                hwy::Prefetch(&image_.row(y)[x].r + i);
    }

private:
    ColorView image_;
    Rgb copies_[2][tile_width];
};

// A tile's samples, then coefficients, and the order in which its blocks are coded.
class Tile {
public:
    explicit Tile(bool halve_chroma) : halve_chroma_(halve_chroma) {
        Block* next = order_;
        const auto add = [&](const BlockRow& row, int index, int component, int x, int y) {
            *next++ = {row.values[0] + 8 * index,
                       row.nonzero[0] + index,
                       &codes[component > 0],
                       &previous_[component],
                       x,
                       y};
        };
        for (int unit = 0; unit < tile_width / unit_size(); ++unit) {
            const int x = unit * unit_size();
            for (int y = 0; y < unit_size(); y += 8)
                for (int dx = 0; dx < unit_size(); dx += 8)
                    add(luma_[y / 8], widened_block((x + dx) / 8), 0, x + dx, y);
            const int small = halve_chroma ? unit : widened_block(unit);
            add(cb_, small, 1, x, 0);
            add(cr_, small, 2, x, 0);
        }
    }
    Tile(const Tile&) = delete;

    int unit_size() const { return halve_chroma_ ? 16 : 8; }

    HWY_INLINE void convert_pixels(TileRows& rows, int x, int y) {
        for (int i = 0; i < 8; ++i) {
            if (halve_chroma_) {
                BlockRow& to = luma_[i / 4];
                const int row = 2 * i % 8;
                convert_halved(rows.get(x, y + 2 * i, 0), rows.get(x, y + 2 * i + 1, 1),
                               to.values[row], to.values[row + 1], cb_.values[i], cr_.values[i]);
            } else {
                convert(rows.get(x, y + i, 0), luma_[0].values[i], cb_.values[i], cr_.values[i]);
            }
        }
    }

    HWY_INLINE void transform_samples(const ScanTables& tables) {
        for (int i = 0; i < unit_size() / 8; ++i)
            transform_row<true>(luma_[i], tile_width, tables.factor[0], tables.scale[0]);
        for (BlockRow* row : {&cb_, &cr_})
            transform_row<false>(*row, halve_chroma_ ? tile_width / 2 : tile_width,
                                 tables.factor[1], tables.scale[1]);
    }

    // `width` x `height` pixels of the tile lie in the picture.
    HWY_INLINE void code_units(int width, int height, BitWriter& out) {
        const int units = (std::min(width, tile_width) + unit_size() - 1) / unit_size();
        const Block* const end = order_ + units * (halve_chroma_ ? 6 : 3);
        const bool whole = width >= tile_width && height >= unit_size();
        for (const Block* block = order_; block != end; ++block)
            if (whole || (block->x < width && block->y < height)) [[likely]]
                code_block(*block, out);
            else
                skip_block(*block, out);
    }

private:
    bool halve_chroma_;
    BlockRow luma_[2], cb_, cr_;
    int previous_[3] = {};
    Block order_[3 * tile_blocks];
};

std::uint8_t* encode_scan(ColorView image, bool halve_chroma, const ScanTables& tables,
                          std::uint8_t* row_buffer, std::uint8_t* out) {
    const auto [width, height] = image.size;
    TileRows rows(image);
    Tile tile(halve_chroma);
    BitWriter bits(row_buffer);
    for (int y = 0; y < height; y += tile.unit_size()) {
        for (int x = 0; x < width; x += tile_width) {
            if (x + tile_width < width)
                rows.fetch(x + tile_width, y, tile.unit_size());
            else
                rows.fetch(0, y + tile.unit_size(), tile.unit_size());
            tile.convert_pixels(rows, x, y);
            tile.transform_samples(tables);
            tile.code_units(width - x, height - y, bits);
        }
        if (y + tile.unit_size() >= height && bits.count() > 0) {
            // The last byte is filled up with ones.
            const unsigned missing = 8 - bits.count();
            bits.put(((1u << missing) - 1) << 6 | missing);
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
