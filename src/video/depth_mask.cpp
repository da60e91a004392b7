// SPDX-License-Identifier: Apache-2.0
#include "video/depth_mask.h"

#include <array>
#include <cassert>

namespace theatron::video::depth_mask {
namespace {

// A carry-less range coder over binary decisions with adaptive probabilities, as
// in LZMA: 11 bits of probability, moved by 1/16 of the error.
constexpr int probability_bits = 11, adaptation = 4;
constexpr std::uint32_t renormalise_below = 1u << 24;
constexpr std::size_t contexts = 1 << 10;

using Probabilities = std::array<std::uint16_t, contexts>;

Probabilities even_chances() {
    Probabilities p;
    p.fill(1 << (probability_bits - 1));
    return p;
}

void adapt(std::uint16_t& probability_of_0, bool bit) {
    if (bit)
        probability_of_0 = std::uint16_t(probability_of_0 - (probability_of_0 >> adaptation));
    else
        probability_of_0 = std::uint16_t(
            probability_of_0 + (((1 << probability_bits) - probability_of_0) >> adaptation));
}

class BitEncoder {
public:
    explicit BitEncoder(std::byte* out) : begin_(out), out_(out) {}

    void put(std::uint16_t& probability_of_0, bool bit) {
        const std::uint32_t bound = (range_ >> probability_bits) * probability_of_0;
        if (bit) {
            low_ += bound;
            range_ -= bound;
        } else {
            range_ = bound;
        }
        adapt(probability_of_0, bit);
        while (range_ < renormalise_below) {
            range_ <<= 8;
            shift();
        }
    }
    std::size_t finish() {
        for (int i = 0; i < 5; ++i)
            shift();
        return std::size_t(out_ - begin_);
    }

private:
    // A carry may still run through the bytes that are held back.
    void shift() {
        if (low_ < 0xff000000u || low_ > 0xffffffffu) {
            const auto carry = std::uint8_t(low_ >> 32);
            for (; held_ > 0; --held_) {
                *out_++ = std::byte(std::uint8_t(first_held_ + carry));
                first_held_ = 0xff;
            }
            first_held_ = std::uint8_t(low_ >> 24);
        }
        ++held_;
        low_ = (low_ & 0x00ffffff) << 8;
    }

    std::byte *begin_, *out_;
    std::uint64_t low_ = 0;
    std::uint32_t range_ = 0xffffffff;
    std::uint8_t first_held_ = 0;
    std::size_t held_ = 1;
};

class BitDecoder {
public:
    explicit BitDecoder(ByteView in) : in_(in) {
        for (int i = 0; i < 5; ++i)
            code_ = code_ << 8 | next();
    }

    bool get(std::uint16_t& probability_of_0) {
        const std::uint32_t bound = (range_ >> probability_bits) * probability_of_0;
        const bool bit = code_ >= bound;
        if (bit) {
            code_ -= bound;
            range_ -= bound;
        } else {
            range_ = bound;
        }
        adapt(probability_of_0, bit);
        while (range_ < renormalise_below) {
            range_ <<= 8;
            code_ = code_ << 8 | next();
        }
        return bit;
    }
    Status status() const {
        return at_ > in_.size()   ? Status::truncated
               : at_ < in_.size() ? Status::trailing_bytes
                                  : Status::ok;
    }

private:
    // Returns zeros after the end; status() then reports it.
    std::uint32_t next() {
        const std::size_t at = at_++;
        return at < in_.size() ? std::to_integer<std::uint32_t>(in_[at]) : 0;
    }

    ByteView in_;
    std::size_t at_ = 0;
    std::uint32_t code_ = 0, range_ = 0xffffffff;
};

// The ten neighbours that both sides know.
unsigned context_of(const std::uint8_t* at, std::ptrdiff_t stride, const std::uint8_t* before) {
    return unsigned(at[-1] | at[-2] << 1 | at[-stride] << 2 | at[-stride - 1] << 3 |
                    at[-stride + 1] << 4 | at[-2 * stride] << 5 | before[0] << 6 | before[1] << 7 |
                    before[stride] << 8 | before[-1] << 9);
}

// Calls code(context, pixel) for each pixel.
template <class Pixels, class Code>
void for_each_pixel(Pixels& mask, const Mask& before, Code code) {
    for (int y = 0; y < mask.size().height; ++y) {
        auto* at = mask.row(y);
        const std::uint8_t* earlier = before.row(y);
        for (int x = 0; x < mask.size().width; ++x)
            code(context_of(at + x, mask.stride(), earlier + x), at[x]);
    }
}

}  // namespace

void Mask::resize(Size size) {
    size_ = size;
    pixels_.assign(std::size_t(size.width + 4) * std::size_t(size.height + 3), 0);
}

void Mask::set_from(DepthView depth) {
    if (size_ != depth.size)
        resize(depth.size);
    for (int y = 0; y < size_.height; ++y) {
        const std::uint16_t* from = depth.row(y);
        std::uint8_t* to = row(y);
        for (int x = 0; x < size_.width; ++x)
            to[x] = from[x] != 0;
    }
}

std::size_t max_encoded_size(Size size) {
    // A decision costs at most seven bits: no probability falls below 15 in 2048.
    return size.area() + 16;
}

std::size_t encode(const Mask& mask, const Mask& before, std::span<std::byte> out) {
    assert(before.size() == mask.size() && out.size() >= max_encoded_size(mask.size()));
    Probabilities probabilities = even_chances();
    BitEncoder encoder(out.data());
    for_each_pixel(mask, before, [&](unsigned context, std::uint8_t pixel) {
        encoder.put(probabilities[context], pixel != 0);
    });
    return encoder.finish();
}

Status decode(ByteView encoded, const Mask& before, Mask& mask) {
    assert(before.size() == mask.size());
    Probabilities probabilities = even_chances();
    BitDecoder decoder(encoded);
    for_each_pixel(mask, before, [&](unsigned context, std::uint8_t& pixel) {
        pixel = decoder.get(probabilities[context]);
    });
    return decoder.status();
}

}  // namespace theatron::video::depth_mask
