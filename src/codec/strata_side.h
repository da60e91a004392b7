// SPDX-License-Identifier: Apache-2.0
// A small adaptive binary range coder for Strata's side information: probability
// tables and value lists, a few hundred bytes a frame. Written for simplicity, not
// for speed.
#pragma once

#include <cstdint>

#include "base/bytes.h"

namespace theatron::codec::strata {

// Adaptive probability of a 0 bit, in units of 1/4096.
class AdaptiveBit {
public:
    std::uint32_t zero() const { return zero_; }
    void saw(bool bit) {
        if (bit)
            zero_ -= zero_ >> 4;
        else
            zero_ += (4096u - zero_) >> 4;
    }

private:
    std::uint32_t zero_ = 2048;
};

class SideWriter {
public:
    explicit SideWriter(Bytes& out) : out_(out) { out_.clear(); }

    void put(bool bit, AdaptiveBit& model) {
        const std::uint32_t split = (range_ >> 12) * model.zero();
        if (bit) {
            low_ += split;
            range_ -= split;
        } else {
            range_ = split;
        }
        model.saw(bit);
        while (range_ < 1u << 24) {
            range_ <<= 8;
            shift();
        }
    }
    // Ends the sequence. No put() may follow.
    void finish() {
        for (int i = 0; i < 5; ++i)
            shift();
    }

private:
    // Outputs the top byte of `low_`. A run of 0xff bytes is held back until a later
    // byte decides whether a carry passes through it.
    void shift() {
        if (low_ < 0xff000000u || low_ > 0xffffffffu) {
            const auto carry = std::uint8_t(low_ >> 32);
            if (has_byte_)
                out_.push_back(std::byte(std::uint8_t(byte_ + carry)));
            for (; waiting_ > 0; --waiting_)
                out_.push_back(std::byte(std::uint8_t(0xff + carry)));
            byte_ = std::uint8_t(low_ >> 24);
            has_byte_ = true;
        } else {
            ++waiting_;
        }
        low_ = (low_ & 0x00ffffffu) << 8;
    }

    Bytes& out_;
    std::uint64_t low_ = 0;
    std::uint32_t range_ = 0xffffffffu;
    std::uint32_t waiting_ = 0;
    std::uint8_t byte_ = 0;
    bool has_byte_ = false;
};

// Reads the output of SideWriter. Past the end it reads zeros; ok() is then false.
class SideReader {
public:
    explicit SideReader(ByteView in) : in_(in) {
        for (int i = 0; i < 4; ++i)
            code_ = code_ << 8 | next();
    }

    bool get(AdaptiveBit& model) {
        const std::uint32_t split = (range_ >> 12) * model.zero();
        const bool bit = code_ >= split;
        if (bit) {
            code_ -= split;
            range_ -= split;
        } else {
            range_ = split;
        }
        model.saw(bit);
        while (range_ < 1u << 24) {
            range_ <<= 8;
            code_ = code_ << 8 | next();
        }
        return bit;
    }
    // True if exactly the bytes given were consumed.
    bool ok() const { return !past_end_ && at_ == in_.size(); }

private:
    std::uint32_t next() {
        if (at_ == in_.size()) {
            past_end_ = true;
            return 0;
        }
        return std::to_integer<std::uint32_t>(in_[at_++]);
    }

    ByteView in_;
    std::size_t at_ = 0;
    std::uint32_t range_ = 0xffffffffu;
    std::uint32_t code_ = 0;
    bool past_end_ = false;
};

// Integers up to 2^16 - 1: the number of binary digits in unary, then the digits.
class NumberModel {
public:
    void put(unsigned value, SideWriter& side) {
        int bits = 0;
        while ((value + 1) >> (bits + 1) != 0)
            ++bits;
        for (int i = 0; i < bits; ++i)
            side.put(true, length_[i]);
        if (bits < max_bits)
            side.put(false, length_[bits]);
        for (int i = bits - 1; i >= 0; --i)
            side.put((value + 1) >> i & 1, bits_[bits][i]);
    }
    unsigned get(SideReader& side) {
        int bits = 0;
        while (bits < max_bits && side.get(length_[bits]))
            ++bits;
        unsigned value = 1;
        for (int i = bits - 1; i >= 0; --i)
            value = value << 1 | unsigned(side.get(bits_[bits][i]));
        return value - 1;
    }

private:
    static constexpr int max_bits = 16;
    AdaptiveBit length_[max_bits + 1];
    AdaptiveBit bits_[max_bits + 1][max_bits];
};

}  // namespace theatron::codec::strata
