// SPDX-License-Identifier: Apache-2.0
// Coded bytes to coefficients, once per instruction set: included by
// jpeg_scan.cpp alone.
#if defined(THEATRON_JPEG_BITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_JPEG_BITS_INL
#undef THEATRON_JPEG_BITS_INL
#else
#define THEATRON_JPEG_BITS_INL
#endif

#include "hwy/highway.h"
#include "video/jpeg_pixels.h"
#include "video/jpeg_scan.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::video::jpeg_scan::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The bytes from one marker to the next.
struct Interval {
    std::size_t size = 0;
    JpegMarker end;
};

// Copies the coded bytes up to the next marker without the zeros stuffed after
// each 0xff, so that reading bits needs no test for either. Writes up to a vector
// more.
HWY_INLINE Interval unstuff(ByteView coded, std::size_t from, std::uint8_t* out) {
    const hn::CappedTag<std::uint8_t, alignment> d;
    const std::size_t lanes = hn::Lanes(d);
    const auto mark = hn::Set(d, 0xff);
    const auto* const in = reinterpret_cast<const std::uint8_t*>(coded.data());
    const std::size_t size = coded.size();
    std::uint8_t* const begin = out;

    std::size_t i = from;
    while (i < size) {
        if (i + lanes <= size) {
            const auto bytes = hn::LoadU(d, in + i);
            hn::StoreU(bytes, d, out);
            const std::intptr_t found = hn::FindFirstTrue(d, hn::Eq(bytes, mark));
            if (found < 0) {
                i += lanes;
                out += lanes;
                continue;
            }
            i += std::size_t(found);
            out += found;
        } else if (in[i] != 0xff) {
            *out++ = in[i++];
            continue;
        }
        std::size_t after = i + 1;
        while (after < size && in[after] == 0xff)
            ++after;
        if (after == size)
            break;
        if (in[after] != 0)
            return {std::size_t(out - begin), {i, after + 1, in[after]}};
        *out++ = 0xff;
        i = after + 1;
    }
    return {std::size_t(out - begin), {size, size, 0}};
}

// Reads bits, highest first, without looking for the end.
class Bits {
public:
    explicit Bits(const std::uint8_t* from) : at_(from) {}

    // At least 56 bits are there afterwards. The bits beyond `left_` that are there
    // already are the same as those that come again.
    HWY_INLINE void refill() {
        std::uint64_t next = 0;
        for (int i = 0; i < 8; ++i)
            next = next << 8 | at_[i];
        buffer_ |= next >> left_;
        at_ += (63 - left_) >> 3;
        left_ |= 56;
    }
    HWY_INLINE std::size_t front(int count) const { return std::size_t(buffer_ >> (64 - count)); }
    HWY_INLINE void take(std::uint32_t count) {
        buffer_ <<= count;
        left_ -= count;
    }
    const std::uint8_t* at() const { return at_; }
    std::size_t taken(const std::uint8_t* from) const {
        return std::size_t(at_ - from) * 8 - left_;
    }

private:
    const std::uint8_t* at_;
    std::uint64_t buffer_ = 0;
    std::uint32_t left_ = 0;
};

inline constexpr auto places = [] {
    std::array<std::uint16_t, 64> all{};
    for (std::size_t k = 0; k < 64; ++k)
        all[k] = std::uint16_t(place(k, quad_row));
    return all;
}();

// The blocks of a group in coding order: the memory for the coefficients of each, and
// its component, which has the codes. One more entry is loaded but not used.
struct Plan {
    static constexpr std::size_t most = group_units * max_unit_blocks + 1;
    std::array<std::int16_t*, most> blocks{};
    std::array<const Component*, most> components{};
    // Addresses in JpegLookup: of the entries inside the block, and those that differ
    // from it in these bits at the start of the next.
    std::array<std::uintptr_t, most> inside{}, change{};
};

// Reads one symbol that `entry` does not decide, or one near the end of a block.
// `k` is the coefficient before; afterwards that of the symbol, or 64 if the block
// ends. False if the bits are damaged.
inline HWY_NOINLINE bool read_one(Bits& in, const JpegHuffmanCode& code, bool is_dc,
                                  const JpegLookup::Entry& entry, std::int16_t* block,
                                  std::size_t& k) {
    in.refill();
    JpegSymbol symbol{entry.bits, entry.first};
    if (entry.second != JpegLookup::undecided || entry.bits == 0)
        symbol = find_jpeg_symbol(code, unsigned(in.front(16)));
    if (symbol.bits == 0)
        return false;
    in.take(std::uint32_t(symbol.bits));
    const int run = symbol.value >> 4, size = symbol.value & 15;
    int value = 0;
    if (size > 0) {
        const int bits = int(in.front(size));
        in.take(std::uint32_t(size));
        value = bits >> (size - 1) ? bits : bits + 1 - (1 << size);
    } else if (!is_dc && run != 15) {
        k = 64;
        return true;
    }
    if (!is_dc)
        k += std::size_t(run + 1);
    if (k > 63)
        return false;
    block[places[k]] = std::int16_t(value);
    if (k == 63)
        k = 64;
    return true;
}

// Reads the blocks of the plan from `i` to `last` into zeros, DC as the difference.
// False if they are damaged or go beyond `limit`.
//
// There is no branch between blocks: the end of a block is unpredictable, so the table
// and the place of the next coefficient are chosen by arithmetic alone.
inline bool read_blocks(Bits& all_bits, const Plan& plan, const JpegLookup& lookup, std::size_t i,
                        std::size_t last, const std::uint8_t* limit) {
    Bits in = all_bits;
    const auto start = [&] { return std::uintptr_t(lookup.start(plan.components[i]->lookup)); };
    std::uintptr_t table = start();
    std::size_t k = 0;  // of the coefficient before
    while (true) {
        constexpr int looks = 56 / JpegLookup::look;
        in.refill();
        if (HWY_UNLIKELY(in.at() > limit))
            return false;
        for (int n = 0; n < looks; ++n) {
            const JpegLookup::Entry& entry =
                reinterpret_cast<const JpegLookup::Entry*>(table)[in.front(JpegLookup::look)];
            const std::size_t first = k + entry.first, second = k + entry.second;
            std::int16_t* const block = plan.blocks[i];
            if (HWY_UNLIKELY(second > 62)) {
                const bool is_dc = table != plan.inside[i];
                const JpegComponent& codes = *plan.components[i]->codes;
                all_bits = in;
                if (!read_one(all_bits, is_dc ? codes.dc : codes.ac, is_dc, entry, block, k))
                    return false;
                in = all_bits;
                table = plan.inside[i];
                if (k == 64) {
                    if (++i == last)
                        return true;
                    k = 0;
                    table = start();
                }
                break;
            }
            in.take(entry.bits);
            // In this order: where there is no second, the first takes its place.
            block[places[second]] = entry.second_value;
            block[places[first]] = entry.first_value;
            const std::ptrdiff_t ends = entry.ends;
            table = plan.inside[i] ^ (plan.change[i] & std::uintptr_t(ends));
            k = second & ~std::size_t(ends);
            i -= std::size_t(ends);
            if (i == last) {
                all_bits = in;
                return true;
            }
        }
    }
}

}  // namespace theatron::video::jpeg_scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
