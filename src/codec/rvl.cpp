// SPDX-License-Identifier: Apache-2.0
#include "codec/rvl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "codec/lanes.h"
#include "codec/payload_header.h"
#include "codec/rows.h"

namespace theatron::codec::rvl {
namespace {

// --- Nibbles out -------------------------------------------------------------

// The nibbles of a number below 512 and, from bit 12 on, their count.
constexpr auto short_codes = [] {
    std::array<std::uint16_t, 512> codes{};
    for (unsigned v = 0; v < 512; ++v) {
        const unsigned count = v < 8 ? 1 : v < 64 ? 2 : 3;
        unsigned nibbles = (v & 7) | (v & 0x38) << 1 | (v & 0x1c0) << 2;
        nibbles |= count > 1 ? 0x008 : 0;
        nibbles |= count > 2 ? 0x080 : 0;
        codes[v] = std::uint16_t(nibbles | count << 12);
    }
    return codes;
}();

// Collects nibbles, lowest first. Writes eight bytes at a time; up to seven of them
// are overwritten later, so the buffer needs that much slack at its end.
class NibbleWriter {
public:
    explicit NibbleWriter(std::byte* out) : begin_(out), out_(out) {}

    // At most 56 bits at a time.
    void put_bits(std::uint64_t bits, unsigned count) {
        pending_ |= bits << pending_count_;
        pending_count_ += count;
        store_lanes(out_, pending_);
        out_ += pending_count_ / 8;
        pending_ >>= pending_count_ & ~7u;
        pending_count_ %= 8;
    }

    void put_number(std::uint32_t value) {
        if (value < 512) {
            const std::uint16_t code = short_codes[value];
            put_bits(code & 0xfff, (code >> 12) * 4u);
            return;
        }
        std::uint64_t bits = 0;
        unsigned count = 0;
        for (; value >= 8; value >>= 3, count += 4)
            bits |= std::uint64_t(8 | (value & 7)) << count;
        put_bits(bits | std::uint64_t(value) << count, count + 4);
    }

    void put_lengths(std::uint32_t empty, std::uint32_t measured) {
        if ((empty | measured) < 8) {
            put_bits(empty | measured << 4, 8);
            return;
        }
        put_number(empty);
        put_number(measured);
    }

    // The number of bytes written. An unused half of the last byte is zero.
    std::size_t finish() const { return std::size_t(out_ - begin_) + (pending_count_ > 0 ? 1 : 0); }

private:
    std::byte* begin_;
    std::byte* out_;
    std::uint64_t pending_ = 0;
    unsigned pending_count_ = 0;  // 0 or 4 bits
};

constexpr std::size_t write_slack = 8;

// --- Runs --------------------------------------------------------------------

std::size_t end_of_zeros(const std::uint16_t* values, std::size_t at, std::size_t count) {
    for (; at + 4 <= count; at += 4) {
        if (const Lanes lanes = load_lanes(values + at); lanes != 0)
            return at + std::size_t(std::countr_zero(lanes)) / 16;
    }
    while (at < count && values[at] == 0)
        ++at;
    return at;
}

std::size_t end_of_nonzeros(const std::uint16_t* values, std::size_t at, std::size_t count) {
    for (; at + 4 <= count; at += 4) {
        if (const Lanes zeros = lowest_zero_lane(load_lanes(values + at)); zeros != 0)
            return at + std::size_t(std::countr_zero(zeros)) / 16;
    }
    while (at < count && values[at] != 0)
        ++at;
    return at;
}

// Writes the zigzagged differences of the first `count` (1 to 4) lanes.
inline void put_differences(NibbleWriter& out, Lanes codes, unsigned count) {
    codes &= lowest_lanes(count);
    if ((codes & 0xfe00'fe00'fe00'fe00) != 0) {
        for (unsigned i = 0; i < count; ++i)
            out.put_number(lane(codes, i));
        return;
    }
    const unsigned c0 = short_codes[lane(codes, 0)];
    const unsigned c1 = short_codes[lane(codes, 1)];
    const unsigned c2 = short_codes[lane(codes, 2)];
    const unsigned c3 = short_codes[lane(codes, 3)];
    const unsigned n0 = c0 >> 12, n1 = c1 >> 12, n2 = c2 >> 12, n3 = c3 >> 12;
    const std::uint64_t low = (c0 & 0xfff) | std::uint64_t(c1 & 0xfff) << (4 * n0);
    const std::uint64_t high = (c2 & 0xfff) | std::uint64_t(c3 & 0xfff) << (4 * n2);
    const std::uint64_t bits = low | high << (4 * (n0 + n1));
    // The unused lanes gave single zero nibbles at the end, which are left out.
    out.put_bits(bits, 4 * (n0 + n1 + n2 + n3 - (4 - count)));
}

// --- Nibbles in --------------------------------------------------------------

// Decodes the next three nibbles: up to three complete numbers, zigzagged differences,
// as running sums, so that one addition decodes all of them.
// Lanes 0 to 2 are the sums after one, two and three numbers; with fewer numbers the
// last sum repeats. Lane 3, from bit 48 on: the count of numbers (2 bits), the nibbles
// of none, one, two and three of them (2 bits each), two unused bits, and the bits of
// all together (4 bits).
constexpr unsigned numbers_in(std::uint64_t entry) {
    return unsigned(entry >> 48) & 3;
}
constexpr unsigned nibbles_of(std::uint64_t entry, unsigned numbers) {
    return unsigned(entry >> (50 + 2 * numbers)) & 3;
}
constexpr unsigned bits_of_all(std::uint64_t entry) {
    return unsigned(entry >> 60);
}

constexpr auto short_decodes = [] {
    std::array<std::uint64_t, 4096> entries{};
    for (unsigned bits = 0; bits < 4096; ++bits) {
        std::uint64_t sums = 0, counts = 0;
        unsigned numbers = 0, at = 0;
        std::uint16_t sum = 0;
        while (at < 3) {
            unsigned value = 0, nibble = 0, end = at;
            do {
                nibble = bits >> (4 * end) & 15;
                value |= (nibble & 7) << (3 * (end - at));
                ++end;
            } while (nibble >= 8 && end < 3);
            // Incomplete, or with a zero as last group, which the encoder never writes.
            if (nibble >= 8 || (nibble == 0 && end - at > 1))
                break;
            at = end;
            sum = std::uint16_t(sum + unzigzag(std::uint16_t(value)));
            for (unsigned l = numbers; l < 3; ++l)
                sums = (sums & ~(0xffffull << (16 * l))) | std::uint64_t(sum) << (16 * l);
            ++numbers;
            counts |= std::uint64_t(end) << (2 + 2 * numbers);
        }
        entries[bits] = sums | (counts | numbers | std::uint64_t(4 * at) << 12) << 48;
    }
    return entries;
}();

// Reads nibbles, lowest first. Past the end it reads zeros; consumed() then exceeds
// the input.
class NibbleReader {
public:
    explicit NibbleReader(ByteView in) : in_(in) {}

    // At least the next 14 nibbles, lowest first.
    std::uint64_t peek() {
        if (count_ < 56)
            refill();
        return window_;
    }
    void skip_bits(unsigned bits) {
        window_ >>= bits;
        count_ -= bits;
    }

    // Reads one number up to `max`; false if the next nibbles are not such a number.
    bool get_number(std::uint32_t max, std::uint32_t& value) {
        std::uint64_t bits = peek();
        std::uint64_t result = 0;
        for (unsigned i = 0; i < 9; ++i, bits >>= 4) {
            result |= (bits & 7) << (3 * i);
            if ((bits & 8) == 0) {
                value = std::uint32_t(result);
                skip_bits(4 * (i + 1));
                return result <= max && ((bits & 7) != 0 || i == 0);
            }
        }
        return false;
    }

    std::size_t consumed() const { return 2 * at_ - count_ / 4; }

private:
    void refill() {
        std::uint64_t next = 0;
        if (at_ + 8 <= in_.size())
            std::memcpy(&next, in_.data() + at_, 8);
        else if (at_ < in_.size())
            std::memcpy(&next, in_.data() + at_, in_.size() - at_);
        // A byte that fits only in part is ORed in again, with equal bits, next time.
        window_ |= next << count_;
        const unsigned bytes = (63 - count_) / 8;
        at_ += bytes;
        count_ += 8 * bytes;
    }

    ByteView in_;
    std::size_t at_ = 0;  // next byte to load; may run past the end
    std::uint64_t window_ = 0;
    unsigned count_ = 0;  // valid bits of `window_`
};

// Decodes runs into `values`. Each step returns false on failure.
class RunDecoder {
public:
    RunDecoder(ByteView in, std::span<std::uint16_t> values)
        : nibbles_(in), nibble_count_(2 * in.size()), v_(values.data()), count_(values.size()) {}

    bool done() const { return at_ == count_; }

    // Decodes one run of empty pixels and one of measured pixels.
    bool decode_pair() {
        if (const std::uint64_t window = nibbles_.peek(); is_short_pair(window))
            return decode_short_pair(window);
        std::uint32_t empty = 0, measured = 0;
        if (!nibbles_.get_number(std::uint32_t(count_ - at_), empty) ||
            !nibbles_.get_number(std::uint32_t(count_ - at_ - empty), measured))
            return false;
        // A truncated input also ends here: it continues as zeros.
        if ((empty == 0 && at_ > 0) || (measured == 0 && at_ + empty < count_))
            return false;
        put_empty(empty);
        const std::size_t end = at_ + measured;
        // The first measured pixel has no predecessor.
        if (previous_ == 0 && measured > 0 && !decode_one())
            return false;
        // Twelve short numbers and a long one; each store writes four pixels.
        while (end - at_ >= 13 && count_ - at_ >= 16) {
            if (!decode_up_to_13())
                return false;
        }
        while (at_ < end) {
            if (!decode_up_to_3(end))
                return false;
        }
        return true;
    }

    // The reason of a failed step.
    Status problem() const {
        return nibbles_.consumed() > nibble_count_ ? Status::truncated : Status::malformed;
    }

    Status finish() {
        if (nibbles_.consumed() > nibble_count_)
            return Status::truncated;
        const std::size_t left = nibble_count_ - nibbles_.consumed();
        if (left > 1)
            return Status::trailing_bytes;
        const bool clean = left == 0 || (nibbles_.peek() & 15) == 0;
        return clean && zero_seen_ == 0 ? Status::ok : Status::malformed;
    }

private:
    // True for a pair of short runs, the most frequent case where few pixels change.
    bool is_short_pair(std::uint64_t window) const {
        const bool single_nibbles = (window & 0x88) == 0;
        const bool both = (window & 0x07) != 0 && (window & 0x70) != 0;
        return single_nibbles && both && previous_ != 0 && count_ - at_ >= 16;
    }

    // Decodes lengths and first measured pixels from one window, without a branch on
    // the number of pixels: a misprediction would cost more than the unneeded work.
    bool decode_short_pair(std::uint64_t window) {
        const unsigned empty = window & 7;
        const unsigned measured = window >> 4 & 7;
        std::uint16_t* to = v_ + at_;
        store_lanes(to, 0);
        store_lanes(to + 4, 0);
        const std::uint64_t entry = short_decodes[window >> 8 & 0xfff];
        const unsigned some = std::min(numbers_in(entry), measured);
        const Lanes decoded = add_lanes(previous_ * every_lane, entry);
        store_lanes(to + empty, decoded);
        zero_seen_ |= lowest_zero_lane(decoded | ~((Lanes{1} << (16 * some)) - 1));
        previous_ = std::uint16_t(previous_ + lane(entry << 16, some));
        nibbles_.skip_bits(8 + 4 * nibbles_of(entry, some));
        const std::size_t end = at_ + empty + measured;
        at_ += empty + some;
        while (at_ < end) {
            if (!decode_up_to_3(end))
                return false;
        }
        return true;
    }

    void put_empty(std::size_t count) {
        if (count <= 8 && count_ - at_ >= 8) {
            store_lanes(v_ + at_, 0);
            store_lanes(v_ + at_ + 4, 0);
        } else {
            std::memset(v_ + at_, 0, 2 * count);
        }
        at_ += count;
    }

    // Decodes all pixels in one window, without a check for the end of the run. A number
    // that is not in the table makes the remaining look-ups advance by zero bits.
    bool decode_up_to_13() {
        std::uint64_t window = nibbles_.peek();
        std::uint16_t* to = v_ + at_;
        unsigned used = 0;
        for (int i = 0; i < 4; ++i) {
            const std::uint64_t entry = short_decodes[window & 0xfff];
            const Lanes decoded = add_lanes(previous_ * every_lane, entry);
            store_lanes(to, decoded);
            zero_seen_ |= lowest_zero_lane(decoded | Lanes{1} << 48);
            to += numbers_in(entry);
            previous_ = std::uint16_t(previous_ + lane(entry, 2));
            used += bits_of_all(entry);
            window >>= bits_of_all(entry);
        }
        at_ = std::size_t(to - v_);
        nibbles_.skip_bits(used);
        return numbers_in(short_decodes[window & 0xfff]) > 0 || decode_one();
    }

    bool decode_up_to_3(std::size_t end) {
        const std::uint64_t entry = short_decodes[nibbles_.peek() & 0xfff];
        const auto some = unsigned(std::min<std::size_t>(numbers_in(entry), end - at_));
        if (some == 0 || count_ - at_ < 4)
            return decode_one();
        const Lanes decoded = add_lanes(previous_ * every_lane, entry);
        store_lanes(v_ + at_, decoded);
        zero_seen_ |= lowest_zero_lane(decoded | ~lowest_lanes(some));
        at_ += some;
        previous_ = lane(decoded, some - 1);
        nibbles_.skip_bits(4 * nibbles_of(entry, some));
        return true;
    }

    bool decode_one() {
        std::uint32_t code = 0;
        if (!nibbles_.get_number(0xffff, code))
            return false;
        previous_ = std::uint16_t(previous_ + unzigzag(std::uint16_t(code)));
        v_[at_++] = previous_;
        return previous_ != 0;
    }

    NibbleReader nibbles_;
    std::size_t nibble_count_;
    std::uint16_t* v_;
    std::size_t count_;
    std::size_t at_ = 0;
    std::uint16_t previous_ = 0;  // the last measured pixel, 0 before the first
    Lanes zero_seen_ = 0;         // non-zero after a measured pixel of value 0: malformed
};

}  // namespace

std::size_t max_encoded_runs(std::size_t count) {
    // At most six nibbles per measured pixel; run lengths take at most one nibble per
    // pixel and two more.
    return (7 * count + 2) / 2 + 1 + write_slack;
}

std::size_t encode_runs(std::span<const std::uint16_t> values, std::span<std::byte> out) {
    assert(out.size() >= max_encoded_runs(values.size()));
    const std::uint16_t* v = values.data();
    const std::size_t count = values.size();
    NibbleWriter nibbles(out.data());
    std::uint16_t previous = 0;
    for (std::size_t at = 0; at < count;) {
        const std::size_t begin = end_of_zeros(v, at, count);
        const std::size_t end = end_of_nonzeros(v, begin, count);
        nibbles.put_lengths(std::uint32_t(begin - at), std::uint32_t(end - begin));
        at = end;
        if (begin == end)
            break;

        std::size_t i = begin;
        if (i + 4 <= count) {
            const Lanes here = load_lanes(v + i);
            const unsigned some = unsigned(std::min<std::size_t>(end - i, 4));
            put_differences(nibbles, zigzag_lanes(subtract_lanes(here, here << 16 | previous)),
                            some);
            i += some;
            for (; i + 4 <= end; i += 4) {
                const Lanes left = load_lanes(v + i - 1);
                put_differences(nibbles, zigzag_lanes(subtract_lanes(load_lanes(v + i), left)), 4);
            }
            if (i < end && i + 4 <= count) {
                const Lanes left = load_lanes(v + i - 1);
                put_differences(nibbles, zigzag_lanes(subtract_lanes(load_lanes(v + i), left)),
                                unsigned(end - i));
                i = end;
            }
            previous = v[i - 1];
        }
        for (; i < end; previous = v[i++])
            nibbles.put_number(zigzag(std::uint16_t(v[i] - previous)));
    }
    return nibbles.finish();
}

Status decode_runs(ByteView encoded, std::span<std::uint16_t> values) {
    RunDecoder decoder(encoded, values);
    while (!decoder.done()) {
        if (!decoder.decode_pair())
            return decoder.problem();
    }
    return decoder.finish();
}

std::size_t max_encoded_size(Size size) {
    return payload_header_size + max_encoded_runs(size.area());
}

std::size_t encode(DepthView depth, std::span<std::byte> out) {
    assert(is_valid(depth.size) && depth.contiguous());
    put_header({.codec = DepthCodecId::rvl, .size = depth.size}, out.data());
    return payload_header_size +
           encode_runs({depth.pixels, depth.size.area()}, out.subspan(payload_header_size));
}

Result<Size> read_size(ByteView encoded) {
    const auto header = read_header(encoded, DepthCodecId::rvl, false);
    if (!header)
        return header.error();
    return header->size;
}

Status decode(ByteView encoded, MutableDepthView out) {
    assert(out.contiguous());
    const auto size = read_size(encoded);
    if (!size)
        return size.error();
    if (*size != out.size)
        return Status::size_mismatch;
    return decode_runs(encoded.subspan(payload_header_size), {out.pixels, out.size.area()});
}

}  // namespace theatron::codec::rvl
