// SPDX-License-Identifier: Apache-2.0
#include "codec/ans_coder.h"

#include <algorithm>
#include <cassert>

namespace theatron::codec::ans {
namespace {

// A coder's state stays in [lowest, lowest << 16).
constexpr std::uint32_t lowest = 1u << 15;

using Frequencies = std::array<std::uint32_t, 256>;

// --- Tables ------------------------------------------------------------------

// Scales counts to a sum of `scale`, keeping every symbol that occurs.
void normalise(Frequencies& counts, std::uint32_t symbols) {
    std::uint64_t total = 0;
    for (std::uint32_t s = 0; s < symbols; ++s)
        total += counts[s];
    if (total == 0) {
        counts[0] = scale;
        return;
    }
    std::uint32_t sum = 0, largest = 0;
    for (std::uint32_t s = 0; s < symbols; ++s) {
        if (counts[s] == 0)
            continue;
        counts[s] = std::max(1u, std::uint32_t(counts[s] * std::uint64_t(scale) / total));
        sum += counts[s];
        if (counts[s] > counts[largest])
            largest = s;
    }
    // A remainder left by rounding goes to the largest. An excess caused by rare symbols,
    // which keep at least 1, is taken from whichever is largest at the time.
    if (sum < scale)
        counts[largest] += scale - sum;
    for (; sum > scale; --sum) {
        largest = std::uint32_t(std::max_element(counts.begin(), counts.begin() + symbols) -
                                counts.begin());
        --counts[largest];
    }
}

// Writes a frequency as one byte below 128, else as two. A zero is followed by the
// number of further zeros. Stops when the frequencies reach `scale`.
std::byte* put_frequencies(const Frequencies& frequencies, std::byte* out) {
    std::uint32_t sum = 0;
    for (std::uint32_t s = 0; sum < scale; ++s) {
        const std::uint32_t f = frequencies[s];
        sum += f;
        if (f >= 128) {
            *out++ = std::byte(0x80 | f >> 8);
            *out++ = std::byte(f & 0xff);
        } else if (f > 0) {
            *out++ = std::byte(f);
        } else {
            std::uint32_t more = 0;
            while (frequencies[s + 1] == 0) {
                ++more;
                ++s;
            }
            *out++ = std::byte{0};
            *out++ = std::byte(more);
        }
    }
    return out;
}

// Reads frequencies into a table that maps each position in [0, scale) to its symbol
// (bits 0-7), frequency (8-19), and distance to the symbol's first position (20-31).
Status get_table(ByteReader& in, std::uint32_t symbols, std::uint32_t* table) {
    std::uint32_t at = 0;
    for (std::uint32_t s = 0; at < scale; ++s) {
        std::uint32_t f = in.get<std::uint8_t>();
        if (f == 0)
            s += in.get<std::uint8_t>();
        else if (f >= 128)
            f = (f & 0x7f) << 8 | in.get<std::uint8_t>();
        if (!in.ok())
            return Status::truncated;
        if (s >= symbols || f > scale - at)
            return Status::malformed;
        for (std::uint32_t i = 0; i < f; ++i)
            table[at + i] = s | f << 8 | i << 20;
        at += f;
    }
    return Status::ok;
}

// --- Extra bits --------------------------------------------------------------

class BitWriter {
public:
    explicit BitWriter(std::byte* out) : out_(out) {}
    void put(std::uint32_t bits, std::uint32_t count) {
        pending_ |= std::uint64_t(bits) << pending_count_;
        pending_count_ += count;
        for (; pending_count_ >= 8; pending_count_ -= 8, pending_ >>= 8)
            *out_++ = std::byte(pending_ & 0xff);
    }
    std::byte* finish() {
        if (pending_count_ > 0)
            *out_++ = std::byte(pending_ & 0xff);
        return out_;
    }

private:
    std::byte* out_;
    std::uint64_t pending_ = 0;
    std::uint32_t pending_count_ = 0;
};

// Past the end it reads zeros, and finished() is false.
class BitReader {
public:
    explicit BitReader(ByteView in) : in_(in) {}
    std::uint32_t get(std::uint32_t count) {
        for (; count_ < count; count_ += 8, ++at_) {
            if (at_ < in_.size())
                window_ |= std::uint64_t(std::to_integer<std::uint8_t>(in_[at_])) << count_;
        }
        const auto bits = std::uint32_t(window_ & ((std::uint64_t{1} << count) - 1));
        window_ >>= count;
        count_ -= count;
        return bits;
    }
    // True if all input was consumed and the unused bits of the last byte are zero.
    bool finished() const { return at_ == in_.size() && window_ == 0; }

private:
    ByteView in_;
    std::size_t at_ = 0;
    std::uint64_t window_ = 0;
    std::uint32_t count_ = 0;
};

// --- Coding ------------------------------------------------------------------

// The four parts of a sequence. The first ones are longer by one if the count is no
// multiple of four.
struct Parts {
    explicit Parts(std::size_t count) {
        for (std::size_t lane = 0, at = 0; lane < lanes; ++lane) {
            begin[lane] = at;
            at += count / lanes + (lane < count % lanes ? 1 : 0);
        }
        steps = count / lanes;
        longer = count % lanes;
    }
    std::array<std::size_t, lanes> begin;
    std::size_t steps;   // taken by all four lanes
    std::size_t longer;  // number of lanes that take one more
};

// 16 bytes, so that the tables of all contexts fit into the first-level cache.
struct EncodeSymbol {
    // (x * reciprocal) >> shift is x / frequency, exactly, for x below 2^31.
    std::uint64_t reciprocal;
    std::uint16_t frequency;
    std::uint16_t start;
    std::uint32_t shift;
};

template <class Model>
std::size_t encode(std::span<const std::uint32_t> numbers, Workspace& work,
                   std::span<std::byte> out) {
    using Symbols = typename Model::Symbols;
    assert(out.size() >= max_encoded_numbers(numbers.size()));
    const Parts parts(numbers.size());
    work.symbols.resize(std::max(work.symbols.size(), numbers.size()));
    std::uint16_t* const work_symbols = work.symbols.data();

    // Finds symbols and contexts, counts each, and writes the extra bits.
    std::array<Frequencies, Model::contexts> counts{};
    work.extra.resize(4 * numbers.size() + 8);
    BitWriter extra(work.extra.data());
    std::array<std::uint32_t, lanes> model;
    for (std::size_t lane = 0; lane < lanes; ++lane)
        model[lane] = Model::start(parts.begin[lane]);
    const auto model_number = [&](std::size_t lane, std::size_t index) {
        const std::uint32_t number = numbers[index];
        const std::uint32_t symbol = Symbols::symbol(number);
        const std::uint32_t context = Model::context(model[lane]);
        model[lane] = Model::next(model[lane], symbol);
        work_symbols[index] = std::uint16_t(context << 8 | symbol);
        ++counts[context][symbol];
        if (const std::uint32_t bits = Symbols::extra_bits(symbol); bits > 0)
            extra.put(number - Symbols::base(symbol), bits);
    };
    for (std::size_t step = 0; step < parts.steps; ++step) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            model_number(lane, parts.begin[lane] + step);
    }
    for (std::size_t lane = 0; lane < parts.longer; ++lane)
        model_number(lane, parts.begin[lane] + parts.steps);
    const auto extra_count = std::size_t(extra.finish() - work.extra.data());

    std::byte* at = out.data();
    std::array<std::array<EncodeSymbol, Symbols::size>, Model::contexts> table;
    for (std::size_t context = 0; context < Model::contexts; ++context) {
        normalise(counts[context], Symbols::size);
        at = put_frequencies(counts[context], at);
        std::uint32_t start = 0;
        for (std::uint32_t s = 0; s < Symbols::size; ++s) {
            const std::uint32_t f = counts[context][s];
            if (f == 0)
                continue;
            const auto log = std::uint32_t(std::bit_width(f - 1));
            const std::uint64_t power = std::uint64_t{1} << (31 + log);
            table[context][s] = {(power + f - 1) / f, std::uint16_t(f), std::uint16_t(start),
                                 31 + log};
            start += f;
        }
    }

    // Encodes backwards, so that the decoder reads forwards.
    work.words.resize(std::max(work.words.size(), numbers.size() + 2 * lanes));
    std::uint16_t* const words_end = work.words.data() + work.words.size();
    std::uint16_t* word = words_end;
    std::array<std::uint32_t, lanes> state;
    state.fill(lowest);
    const auto code = [&](std::size_t lane, std::size_t index) {
        const std::uint16_t coded = work_symbols[index];
        const EncodeSymbol& s = table[coded >> 8][coded & 0xff];
        std::uint32_t x = state[lane];
        // Branch-free, as in decode().
        const std::uint32_t due = x >= std::uint32_t(s.frequency) << 20 ? ~0u : 0u;
        word[-1] = std::uint16_t(x);
        word -= due & 1;
        x >>= due & 16;
        const auto quotient = std::uint32_t(x * s.reciprocal >> s.shift);
        state[lane] = x + s.start + quotient * (scale - s.frequency);
    };
    for (std::size_t lane = parts.longer; lane-- > 0;)
        code(lane, parts.begin[lane] + parts.steps);
    for (std::size_t step = parts.steps; step-- > 0;) {
        for (std::size_t lane = lanes; lane-- > 0;)
            code(lane, parts.begin[lane] + step);
    }

    const auto word_count = std::uint32_t(words_end - word);
    store_le(at, word_count);
    store_le(at + 4, std::uint32_t(extra_count));
    at += 8;
    for (const std::uint32_t x : state) {
        store_le(at, x);
        at += 4;
    }
    std::memcpy(at, word, 2 * std::size_t(word_count));
    at += 2 * std::size_t(word_count);
    std::memcpy(at, work.extra.data(), extra_count);
    return std::size_t(at - out.data()) + extra_count;
}

template <class Model>
Status decode(ByteView& bytes, Workspace& work, std::span<std::uint32_t> numbers) {
    using Symbols = typename Model::Symbols;
    ByteReader in(bytes);
    work.decode_tables.resize(Model::contexts * scale);
    for (int context = 0; context < Model::contexts; ++context) {
        const Status status =
            get_table(in, Symbols::size, work.decode_tables.data() + std::size_t(context) * scale);
        if (status != Status::ok)
            return status;
    }
    const auto word_count = in.get<std::uint32_t>();
    const auto extra_count = in.get<std::uint32_t>();
    std::array<std::uint32_t, lanes> state;
    for (std::uint32_t& x : state)
        x = in.get<std::uint32_t>();
    const ByteView words = in.get_bytes(2 * std::size_t(word_count));
    BitReader extra(in.get_bytes(extra_count));
    if (!in.ok())
        return Status::truncated;
    bytes = in.rest();

    const Parts parts(numbers.size());
    const std::uint32_t* const table = work.decode_tables.data();
    const std::byte* word = words.data();
    const std::byte* const end = word + words.size();
    std::array<std::uint32_t, lanes> model;
    for (std::size_t lane = 0; lane < lanes; ++lane)
        model[lane] = Model::start(parts.begin[lane]);

    const auto decode_symbol = [&](std::size_t lane) {
        const std::uint32_t x = state[lane];
        const std::uint32_t entry = table[Model::context(model[lane]) * scale + (x & (scale - 1))];
        const std::uint32_t symbol = entry & 0xff;
        model[lane] = Model::next(model[lane], symbol);
        state[lane] = (entry >> 8 & 0xfff) * (x >> scale_bits) + (entry >> 20);
        return symbol;
    };
    const auto put_number = [&](std::size_t index, std::uint32_t symbol) {
        std::uint32_t number = symbol;
        if (const std::uint32_t bits = Symbols::extra_bits(symbol); bits > 0)
            number = Symbols::base(symbol) + extra.get(bits);
        numbers[index] = number;
    };

    std::size_t step = 0;
    // A step consumes at most one word per lane.
    for (; step < parts.steps && end - word >= 2 * lanes; ++step) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t symbol = decode_symbol(lane);
            std::uint16_t next;
            std::memcpy(&next, word, 2);
            // Branch-free: the need for a word is hard to predict.
            const std::uint32_t due = state[lane] < lowest ? ~0u : 0u;
            state[lane] = state[lane] << (due & 16) | (next & due);
            word += due & 2;
            put_number(parts.begin[lane] + step, symbol);
        }
    }
    const auto decode_carefully = [&](std::size_t lane, std::size_t index) {
        const std::uint32_t symbol = decode_symbol(lane);
        if (state[lane] < lowest) {
            if (word == end)
                return false;
            state[lane] = state[lane] << 16 | load_le<std::uint16_t>(word);
            word += 2;
        }
        put_number(index, symbol);
        return true;
    };
    for (; step < parts.steps; ++step) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!decode_carefully(lane, parts.begin[lane] + step))
                return Status::malformed;
        }
    }
    for (std::size_t lane = 0; lane < parts.longer; ++lane) {
        if (!decode_carefully(lane, parts.begin[lane] + parts.steps))
            return Status::malformed;
    }
    // The state of each coder ends where the encoder's began.
    const bool clean =
        word == end && extra.finished() &&
        std::all_of(state.begin(), state.end(), [](std::uint32_t x) { return x == lowest; });
    return clean ? Status::ok : Status::malformed;
}

}  // namespace

std::size_t max_encoded_numbers(std::size_t count) {
    // Two bytes per frequency; then one word and 25 extra bits per number.
    return 6 * 2 * 256 + 8 + 2 * 4 * lanes + 6 * count;
}

std::size_t encode_runs(std::span<const std::uint32_t> numbers, Workspace& work,
                        std::span<std::byte> out) {
    return encode<RunModel>(numbers, work, out);
}
std::size_t encode_differences(std::span<const std::uint32_t> numbers, Workspace& work,
                               std::span<std::byte> out) {
    return encode<DifferenceModel>(numbers, work, out);
}
Status decode_runs(ByteView& in, Workspace& work, std::span<std::uint32_t> numbers) {
    return decode<RunModel>(in, work, numbers);
}
Status decode_differences(ByteView& in, Workspace& work, std::span<std::uint32_t> numbers) {
    return decode<DifferenceModel>(in, work, numbers);
}

}  // namespace theatron::codec::ans
