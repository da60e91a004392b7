// SPDX-License-Identifier: Apache-2.0
// Our JPEG encoder's scan in its plainest form, block by block: the definition
// that the kernels must equal. For tests.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <utility>

#include "base/bytes.h"
#include "image/view.h"
#include "video/jpeg_encoder_rule.h"
#include "video/jpeg_zigzag.h"

namespace theatron::video::jpeg {

class ReferenceScan {
public:
    ReferenceScan(ColorView image, int quality, bool halve_chroma)
        : image_(image), quality_(quality), halve_chroma_(halve_chroma) {}

    // Returns the bytes between the headers and the end marker.
    Bytes encode() {
        const int unit = halve_chroma_ ? 16 : 8;
        for (int y = 0; y < image_.size.height; y += unit)
            for (int x = 0; x < image_.size.width; x += unit) {
                for (int row = y; row < y + unit; row += 8)
                    for (int column = x; column < x + unit; column += 8) {
                        if (column < image_.size.width && row < image_.size.height)
                            code(0, [&](int dx, int dy) {
                                return luma_of(pixel(column + dx, row + dy));
                            });
                        else
                            skip();
                    }
                const int step = unit / 8;
                for (const int component : {1, 2})
                    code(component, [&](int dx, int dy) {
                        return chroma(component, x + step * dx, y + step * dy);
                    });
            }
        while (bit_count_ > 0)
            put(1, 1);
        return std::move(out_);
    }

private:
    // Beyond its edges a picture goes on as it ends.
    Rgb pixel(int x, int y) const {
        return image_.row(std::min(y, image_.size.height - 1))[std::min(x, image_.size.width - 1)];
    }

    int chroma(int component, int x, int y) const {
        const ChromaSample sample =
            halve_chroma_
                ? chroma_of({pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1)})
                : chroma_of({pixel(x, y)});
        return component == 1 ? sample.cb : sample.cr;
    }

    template <class Samples>
    void code(int component, Samples samples) {
        int block[64];
        for (int i = 0; i < 64; ++i)
            block[i] = samples(i % 8, i / 8);
        transform_block(block);
        const int kind = component > 0;
        for (int i = 0; i < 64; ++i) {
            block[i] = divided(block[i], divisor_of(step_at(standard_steps[kind][i], quality_)));
        }

        const HuffmanCodes &dc = dc_codes_[kind], &ac = ac_codes_[kind];
        put_value(dc, 0, block[0] - std::exchange(previous_[component], block[0]));
        int zeros = 0;
        for (int k = 1; k < 64; ++k) {
            const int value = block[jpeg_zigzag[k]];
            if (value == 0) {
                ++zeros;
                continue;
            }
            for (; zeros > 15; zeros -= 16)
                put_symbol(ac, sixteen_zeros);
            assert(std::abs(value) < 1024);
            put_value(ac, zeros, value);
            zeros = 0;
        }
        if (zeros > 0)
            put_symbol(ac, end_of_block);
    }

    // A block of luma outside of the picture gets the DC of the one before, and no AC.
    void skip() {
        put_value(dc_codes_[0], 0, 0);
        put_symbol(ac_codes_[0], end_of_block);
    }

    void put_symbol(const HuffmanCodes& codes, int symbol) {
        assert(codes.length[symbol] > 0);
        put(codes.bits[symbol], codes.length[symbol]);
    }

    // How many bits a value has, and those bits; negative ones less 1.
    void put_value(const HuffmanCodes& codes, int zeros, int value) {
        int size = 0;
        while (std::abs(value) >> size != 0)
            ++size;
        put_symbol(codes, zeros << 4 | size);
        put(value < 0 ? value - 1 : value, size);
    }

    void put(int bits, int count) {
        while (count-- > 0) {
            byte_ = byte_ << 1 | (bits >> count & 1);
            if (++bit_count_ < 8)
                continue;
            out_.push_back(std::byte(byte_));
            if ((byte_ & 0xff) == 0xff)
                out_.push_back({});
            byte_ = bit_count_ = 0;
        }
    }

    ColorView image_;
    int quality_;
    bool halve_chroma_;
    const HuffmanCodes dc_codes_[2] = {codes_of(dc_tables[0]), codes_of(dc_tables[1])};
    const HuffmanCodes ac_codes_[2] = {codes_of(ac_tables[0]), codes_of(ac_tables[1])};
    int previous_[3] = {};
    Bytes out_;
    int byte_ = 0, bit_count_ = 0;
};

}  // namespace theatron::video::jpeg
