// SPDX-License-Identifier: Apache-2.0
#include "video/avc_stream.h"

#include <array>

namespace theatron::video::avc {
namespace {

// A sequence header of ours has some 30 bytes; none may need more than this.
constexpr std::size_t max_sequence_bytes = 128;

// Profiles whose sequence headers have the fields for sample formats.
bool is_high_profile(unsigned profile) {
    return profile == 100 || profile == 110;
}
bool is_plain_profile(unsigned profile) {
    return profile == 66 || profile == 77;
}

// Where "00 00 01" begins at or after `from`; stream.size() if nowhere.
std::size_t find_start(ByteView stream, std::size_t from) {
    constexpr std::byte zero{0}, one{1};
    for (std::size_t i = from; i + 2 < stream.size();) {
        // The third byte decides how far the next chance is.
        if (stream[i + 2] > one)
            i += 3;
        else if (stream[i + 2] == one && stream[i] == zero && stream[i + 1] == zero)
            return i;
        else
            ++i;
    }
    return stream.size();
}

// Bits, highest first. A read past the end yields zeros and marks the reader.
class BitReader {
public:
    explicit BitReader(ByteView in) : in_(in) {}

    unsigned bits(int count) {
        unsigned value = 0;
        for (; count > 0; --count) {
            if (at_ / 8 >= in_.size()) {
                ok_ = false;
                return 0;
            }
            const unsigned byte = std::to_integer<unsigned>(in_[at_ / 8]);
            value = value << 1 | (byte >> (7 - at_ % 8) & 1);
            ++at_;
        }
        return value;
    }
    // Exponential Golomb code; none of the fields here needs more than 16 bits.
    unsigned golomb() {
        int zeros = 0;
        while (ok_ && zeros <= 16 && bits(1) == 0)
            ++zeros;
        if (zeros > 16)
            ok_ = false;
        return ok_ ? (1u << zeros) - 1 + bits(zeros) : 0;
    }
    bool ok() const { return ok_; }

private:
    ByteView in_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

// A unit's content without the bytes that keep start codes from appearing in it.
struct Unescaped {
    std::array<std::byte, max_sequence_bytes> bytes;
    std::size_t size = 0;
};
Unescaped unescape(ByteView unit) {
    Unescaped result;
    int zeros = 0;
    for (const std::byte b : unit) {
        if (zeros >= 2 && b == std::byte{3}) {
            zeros = 0;
            continue;
        }
        zeros = b == std::byte{0} ? zeros + 1 : 0;
        result.bytes[result.size++] = b;
    }
    return result;
}

}  // namespace

std::optional<Unit> take_unit(ByteView& stream) {
    const std::size_t start = find_start(stream, 0);
    // One more zero may precede the first start code.
    if (start > 1 || (start == 1 && stream[0] != std::byte{0}))
        return std::nullopt;
    const std::size_t content = start + 3;
    std::size_t end = find_start(stream, content);
    if (end < stream.size() && end > content && stream[end - 1] == std::byte{0})
        --end;
    if (content >= end)
        return std::nullopt;
    const Unit unit{stream.first(end), stream.subspan(content, end - content)};
    stream = stream.subspan(end);
    return unit;
}

Result<Sequence> read_sequence(ByteView unit) {
    if (unit.size() > max_sequence_bytes)
        return Status::too_large;
    const Unescaped plain = unescape(unit);
    BitReader in(ByteView(plain.bytes).first(plain.size));
    (void)in.bits(8);  // unit header
    const unsigned profile = in.bits(8);
    (void)in.bits(16);  // constraints, level
    Sequence sequence;
    bool usual = in.golomb() == 0;  // the only sequence header
    if (is_high_profile(profile)) {
        const unsigned chroma = in.golomb();
        const unsigned luma_bits = in.golomb(), chroma_bits = in.golomb();
        sequence.grey = chroma == 0;
        sequence.bits = int(luma_bits) + 8;
        usual &= chroma <= 1 && (luma_bits == 0 || luma_bits == 2) &&
                 (sequence.grey || chroma_bits == luma_bits);
        usual &= in.bits(1) == 0;  // transform bypass
        usual &= in.bits(1) == 0;  // scaling lists
    } else {
        usual &= is_plain_profile(profile);
    }
    (void)in.golomb();  // length of frame numbers
    const unsigned order = in.golomb();
    if (order == 0)
        (void)in.golomb();  // length of order counts
    usual &= order != 1;
    usual &= in.golomb() <= 1;  // reference frames
    usual &= in.bits(1) == 0;   // gaps in frame numbers
    const std::size_t width = (in.golomb() + 1) * std::size_t(16);
    const std::size_t height = (in.golomb() + 1) * std::size_t(16);
    usual &= in.bits(1) == 1;  // whole frames
    (void)in.bits(1);          // direct prediction
    std::size_t left = 0, right = 0, top = 0, bottom = 0;
    if (in.bits(1)) {
        left = in.golomb();
        right = in.golomb();
        top = in.golomb();
        bottom = in.golomb();
    }
    if (!in.ok())
        return Status::truncated;
    if (!usual)
        return Status::unsupported;
    if (width * height > max_area)
        return Status::too_large;
    const std::size_t step = sequence.grey ? 1 : 2;
    if (step * (left + right) >= width || step * (top + bottom) >= height)
        return Status::malformed;
    sequence.size = {int(width - step * (left + right)), int(height - step * (top + bottom))};
    return sequence;
}

Result<AccessUnit> read_access_unit(ByteView stream) {
    AccessUnit result;
    std::optional<Unit> unit = take_unit(stream);
    if (unit && unit->type() == UnitType::sequence) {
        const auto sequence = read_sequence(unit->content);
        if (!sequence)
            return sequence.error();
        result = {true, *sequence};
        const auto picture = take_unit(stream);
        if (picture && picture->type() != UnitType::picture)
            return Status::unsupported;
        unit = take_unit(stream);
    }
    if (!unit || unit->content.size() < 2)
        return Status::truncated;
    if (unit->type() != (result.key ? UnitType::idr_slice : UnitType::slice))
        return Status::unsupported;
    // The slice begins with the first block: an exponential Golomb 0 is one set bit.
    if ((unit->content[1] & std::byte{0x80}) == std::byte{0})
        return Status::unsupported;
    if (!stream.empty())
        return Status::trailing_bytes;
    return result;
}

}  // namespace theatron::video::avc
