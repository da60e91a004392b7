// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_reference_native.h"

#include <algorithm>
#include <vector>

#include "video/clamped.h"
#include "video/jpeg_baseline.h"
#include "video/jpeg_header.h"
#include "video/jpeg_pixels.h"

namespace theatron::video {
namespace {

using namespace jpeg_pixels;

// The coded bits up to the next marker. Past their end come zeros and a mark.
class BitReader {
public:
    BitReader(ByteView coded, std::size_t from)
        : coded_(coded), at_(from), end_(find_jpeg_marker(coded, from)) {}

    int get() {
        if (left_ == 0) {
            if (at_ >= end_.position) {
                ended_early_ = true;
                return 0;
            }
            byte_ = std::to_integer<int>(coded_[at_++]);
            left_ = 8;
            if (byte_ == 0xff)
                while (coded_[at_++] != std::byte{0}) {
                }
        }
        return byte_ >> --left_ & 1;
    }
    int get(int bits) {
        int value = 0;
        for (int i = 0; i < bits; ++i)
            value = 2 * value + get();
        return value;
    }
    bool ended_early() const { return ended_early_; }
    JpegMarker end() const { return end_; }

private:
    ByteView coded_;
    std::size_t at_;
    JpegMarker end_;
    int byte_ = 0, left_ = 0;
    bool ended_early_ = false;
};

// The next symbol, or -1 for bits that are no code.
int get_symbol(BitReader& in, const JpegHuffmanCode& code) {
    int value = 0, first = 0;
    std::size_t index = 0;
    for (const std::byte counted : code.counts) {
        const int count = std::to_integer<int>(counted);
        value = 2 * value + in.get();
        if (value < first + count)
            return std::to_integer<int>(code.symbols[index + std::size_t(value - first)]);
        first = 2 * (first + count);
        index += std::size_t(count);
    }
    return -1;
}

int get_value(BitReader& in, int bits) {
    if (bits == 0)
        return 0;
    const int value = in.get(bits);
    return value >> (bits - 1) ? value : value + 1 - (1 << bits);
}

std::int16_t add(int a, int b) {
    return std::int16_t(a + b);  // wraps around
}

std::int16_t subtract(int a, int b) {
    return std::int16_t(a - b);
}

std::int16_t times(int a, int factor) {
    return std::int16_t((a * factor + (1 << 14)) >> 15);
}

std::int16_t scaled(int coefficient, ScaledStep step) {
    return times(std::int16_t(coefficient * step.power), step.rest);
}

// Row by row, as the transform takes it.
using Block = std::array<std::int16_t, 64>;

Status get_block(BitReader& in, const JpegComponent& component, std::uint32_t& last_dc,
                 Block& block) {
    block.fill(0);
    const int size = get_symbol(in, component.dc);
    if (size < 0)
        return Status::malformed;
    last_dc += std::uint32_t(get_value(in, size));
    block[0] = scaled(scaled_dc(last_dc, component.steps[0]), dc_step);
    for (std::size_t k = 1; k < 64; ++k) {
        const int symbol = get_symbol(in, component.ac);
        if (symbol < 0)
            return Status::malformed;
        const int run = symbol >> 4, bits = symbol & 15;
        if (bits == 0 && run != 15)
            break;
        k += std::size_t(run);
        if (k >= 64)
            return Status::malformed;
        block[jpeg_zigzag[k]] = scaled(get_value(in, bits), scaled_step(component.steps[k], k));
    }
    return in.ended_early() ? Status::malformed : Status::ok;
}

using Eight = std::array<std::int16_t, 8>;

Eight transformed(const Eight& x) {
    const auto a = add(x[0], x[4]), b = subtract(x[0], x[4]);
    const auto c = add(x[2], x[6]), c2 = subtract(x[2], x[6]);
    const auto d = subtract(add(c2, times(c2, sqrt2_minus_1)), c);
    const Eight even{add(a, c), add(b, d), subtract(b, d), subtract(a, c)};

    const auto p = add(x[1], x[7]), q = add(x[5], x[3]);
    const auto r = subtract(x[1], x[7]), s = subtract(x[5], x[3]);
    const auto pq = subtract(p, q);
    const auto turned_r = subtract(add(r, times(r, rotation_cosine_minus_1)),  //
                                   times(s, rotation_sine));
    const auto turned_s = add(add(s, times(s, rotation_cosine_minus_1)),  //
                              times(r, rotation_sine));
    Eight odd;
    odd[0] = add(p, q);
    odd[1] = subtract(turned_r, odd[0]);
    odd[2] = subtract(add(pq, times(pq, sqrt2_minus_1)), odd[1]);
    odd[3] = subtract(turned_s, odd[2]);

    Eight out;
    for (std::size_t i = 0; i < 4; ++i) {
        out[i] = add(even[i], odd[i]);
        out[7 - i] = subtract(even[i], odd[i]);
    }
    return out;
}

struct Plane {
    Size size;
    std::vector<std::uint8_t> samples;  // a whole number of units

    explicit Plane(Size s) : size(s), samples(s.area()) {}
    int at(int x, int y) const {
        return samples[std::size_t(y) * std::size_t(size.width) + std::size_t(x)];
    }

    void put(const Block& block, int left, int top) {
        std::array<Eight, 8> half;
        for (std::size_t y = 0; y < 8; ++y) {
            Eight row;
            std::copy_n(&block[8 * y], 8, row.begin());
            half[y] = transformed(row);
        }
        for (std::size_t x = 0; x < 8; ++x) {
            Eight column;
            for (std::size_t y = 0; y < 8; ++y)
                column[y] = half[y][x];
            column = transformed(column);
            for (std::size_t y = 0; y < 8; ++y)
                samples[(std::size_t(top) + y) * std::size_t(size.width) + std::size_t(left) + x] =
                    clamped(column[y] >> sample_bits);
        }
    }
};

// Chroma of one pixel around 0, with color_bits after the point: where it is
// halved, three quarters of the nearest sample and one of the next, either way.
int chroma(const BaselineJpeg& jpeg, const Plane& plane, int x, int y) {
    const Size size = jpeg.chroma_size();
    const auto neighbour = [](int i, int count) {
        return std::clamp(i / 2 + (i % 2 ? 1 : -1), 0, count - 1);
    };
    const auto column = [&](int at) {
        if (!jpeg.chroma_shift_y)
            return 4 * (plane.at(at, y) - 128);
        return 3 * plane.at(at, y / 2) + plane.at(at, neighbour(y, size.height)) - 4 * 128;
    };
    constexpr int scale = (1 << color_bits) / 16;
    if (!jpeg.chroma_shift_x)
        return 4 * column(x) * scale;
    return (3 * column(x / 2) + column(neighbour(x, size.width))) * scale;
}

Rgb pixel(int luma, int cb, int cr) {
    const int y = (luma << color_bits) + (1 << (color_bits - 1));
    return {clamped((y + cr + times(cr, red_minus_1)) >> color_bits),
            clamped((y - times(cb, green_blue) - times(cr, green_red)) >> color_bits),
            clamped((y + cb + times(cb, blue_minus_1)) >> color_bits)};
}

}  // namespace

Status decode_jpeg_reference(ByteView bytes, ColorImage& out) {
    const Result<BaselineJpeg> found = read_baseline_jpeg(bytes);
    if (!found)
        return found.error();
    const BaselineJpeg& jpeg = *found;

    const auto [columns, rows] = jpeg.units();
    Plane planes[3] = {Plane({columns * jpeg.unit().width, rows * jpeg.unit().height}),
                       Plane({columns * 8, rows * 8}), Plane({columns * 8, rows * 8})};
    BitReader in(jpeg.coded, 0);
    std::uint32_t last_dc[3] = {};
    for (int unit = 0; unit < columns * rows; ++unit) {
        if (unit > 0 && jpeg.restart_interval > 0 && unit % jpeg.restart_interval == 0) {
            const int expected =
                jpeg_marker::first_restart + (unit / jpeg.restart_interval - 1) % 8;
            if (in.end().code != expected)
                return Status::malformed;
            in = BitReader(jpeg.coded, in.end().after);
            std::fill_n(last_dc, 3, 0);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const int across = i == 0 ? 1 << jpeg.chroma_shift_x : 1;
            const int down = i == 0 ? 1 << jpeg.chroma_shift_y : 1;
            for (int y = 0; y < down; ++y)
                for (int x = 0; x < across; ++x) {
                    Block block;
                    const Status status = get_block(in, jpeg.components[i], last_dc[i], block);
                    if (status != Status::ok)
                        return status;
                    planes[i].put(block, (unit % columns * across + x) * 8,
                                  (unit / columns * down + y) * 8);
                }
        }
    }
    if (!ends_as_jpeg(jpeg.coded, in.end()))
        return Status::malformed;

    out.resize(jpeg.size);
    for (int y = 0; y < jpeg.size.height; ++y)
        for (int x = 0; x < jpeg.size.width; ++x)
            out.view().row(y)[x] = pixel(planes[0].at(x, y), chroma(jpeg, planes[1], x, y),
                                         chroma(jpeg, planes[2], x, y));
    return Status::ok;
}

}  // namespace theatron::video
