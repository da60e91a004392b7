// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_lookup.h"

#include <algorithm>

namespace theatron::video {
namespace {

constexpr int look = JpegLookup::look;

// One symbol with its value.
struct Single {
    int bits = 0;  // of code and value; 0: more than one look-up has
    int distance = 0;
    int value = 0;
    bool end = false;
    int code_bits = 0, symbol = 0;  // of the symbol alone
};
using Singles = std::array<Single, 1 << look>;

Singles singles_of(const JpegHuffmanCode& code, bool is_dc) {
    Singles singles;
    Single* to = singles.data();
    std::size_t index = 0;
    for (int length = 1; length <= look; ++length)
        for (int i = std::to_integer<int>(code.counts[std::size_t(length - 1)]); i > 0; --i) {
            const int symbol = std::to_integer<int>(code.symbols[index++]);
            const int run = symbol >> 4, size = symbol & 15, rest = look - length;
            Single single{length, is_dc ? 0 : run + 1, 0, false, length, symbol};
            if (size == 0) {
                single.end = !is_dc && run != 15;
                to = std::fill_n(to, 1 << rest, single);
            } else if (size > rest) {
                single.bits = 0;
                to = std::fill_n(to, 1 << rest, single);
            } else {
                single.bits += size;
                for (int bits = 0; bits < 1 << size; ++bits) {
                    single.value = bits >> (size - 1) ? bits : bits + 1 - (1 << size);
                    to = std::fill_n(to, 1 << (rest - size), single);
                }
            }
        }
    return singles;
}

JpegLookup::Entry entry_of(const Single& first, const Single* second) {
    if (first.bits == 0)
        return {std::uint8_t(first.code_bits),
                std::uint8_t(first.symbol),
                JpegLookup::undecided,
                0,
                0,
                0};
    const auto distance = std::uint8_t(first.end ? 1 : first.distance);
    JpegLookup::Entry entry{
        std::uint8_t(first.bits),  distance, distance, std::int8_t(-int(first.end)),
        std::int16_t(first.value), 0};
    if (second != nullptr) {
        entry.bits = std::uint8_t(entry.bits + second->bits);
        entry.ends = -int(second->end);
        if (!second->end) {
            entry.second = std::uint8_t(entry.second + second->distance);
            entry.second_value = std::int16_t(second->value);
        }
    }
    return entry;
}

void join(const Singles& firsts, const Singles& seconds, JpegLookup::Entry* out) {
    for (std::size_t i = 0; i < firsts.size(); ++i) {
        const Single& first = firsts[i];
        const Single& second = seconds[i << first.bits & (seconds.size() - 1)];
        const bool fits = !first.end && second.bits > 0 && first.bits + second.bits <= look;
        out[i] = entry_of(first, fits ? &second : nullptr);
    }
}

}  // namespace

void JpegLookup::set(std::size_t component, const JpegHuffmanCode& dc, const JpegHuffmanCode& ac) {
    Key key{};
    auto to = key.begin();
    for (const ByteView part : {dc.counts, ac.counts, dc.symbols, ac.symbols})
        to = std::copy(part.begin(), part.end(), to);
    if (key == keys_[component])
        return;
    keys_[component] = key;
    const Singles dc_singles = singles_of(dc, true), ac_singles = singles_of(ac, false);
    join(dc_singles, ac_singles, &entries_[start_at(component)]);
    join(ac_singles, ac_singles, &entries_[inside_at(component)]);
}

JpegSymbol find_jpeg_symbol(const JpegHuffmanCode& code, unsigned bits) {
    unsigned first = 0;  // code of this length
    std::size_t index = 0;
    for (int length = 1; length <= 16; ++length) {
        const auto count = std::to_integer<unsigned>(code.counts[std::size_t(length - 1)]);
        const unsigned found = bits >> (16 - length);
        if (found < first + count)
            return {length, std::to_integer<int>(code.symbols[index + (found - first)])};
        first = 2 * (first + count);
        index += count;
    }
    return {};
}

}  // namespace theatron::video
