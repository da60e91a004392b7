// SPDX-License-Identifier: Apache-2.0
#include "cases/sample_stream.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace theatron::cases {
namespace {

template <class T>
double value_of(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return double(value);
}

double value_of(SampleType type, const std::byte* bytes) {
    switch (type) {
        case SampleType::i8:
            return value_of<std::int8_t>(bytes);
        case SampleType::u8:
            return value_of<std::uint8_t>(bytes);
        case SampleType::i16:
            return value_of<std::int16_t>(bytes);
        case SampleType::u16:
            return value_of<std::uint16_t>(bytes);
        case SampleType::i32:
            return value_of<std::int32_t>(bytes);
        case SampleType::u32:
            return value_of<std::uint32_t>(bytes);
        case SampleType::i64:
            return value_of<std::int64_t>(bytes);
        case SampleType::u64:
            return value_of<std::uint64_t>(bytes);
        case SampleType::f32:
            return value_of<float>(bytes);
        case SampleType::f64:
            break;
    }
    return value_of<double>(bytes);
}

}  // namespace

bool unpack_gzip(ByteView packed, std::size_t wanted, const std::function<bool(ByteView)>& take) {
    z_stream stream{};
    constexpr int gzip_only = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzip_only) != Z_OK)
        throw std::bad_alloc();
    Bytes piece(64 << 10);
    std::size_t given = 0, done = 0;
    bool good = true, ended = false;
    while (good && !ended && done < wanted) {
        if (stream.avail_in == 0) {
            // zlib counts with 32 bits.
            const std::size_t more = std::min(packed.size() - given, std::size_t(1) << 30);
            stream.next_in =
                reinterpret_cast<Bytef*>(const_cast<std::byte*>(packed.data() + given));
            stream.avail_in = uInt(more);
            given += more;
        }
        const std::size_t room = std::min(piece.size(), wanted - done);
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = uInt(room);
        const int result = inflate(&stream, Z_NO_FLUSH);
        const std::size_t count = room - stream.avail_out;
        if (count > 0)
            good = take(ByteView(piece).first(count));
        done += count;
        ended = result == Z_STREAM_END;
        if (result != Z_OK && !ended)
            good = false;
    }
    inflateEnd(&stream);
    return good && done == wanted;
}

std::size_t size_of(SampleType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[std::size_t(type)];
}

bool LabelCollector::take(ByteView piece) {
    while (good_ && !piece.empty()) {
        if (part_size_ == 0 && piece.size() >= size_) {
            good_ = add(piece.data());
            piece = piece.subspan(size_);
            continue;
        }
        part_[part_size_++] = piece[0];
        piece = piece.subspan(1);
        if (part_size_ == size_) {
            good_ = add(part_);
            part_size_ = 0;
        }
    }
    return good_;
}

bool LabelCollector::add(const std::byte* sample) {
    static_assert(std::endian::native == std::endian::little);
    std::byte bytes[8];
    std::copy_n(sample, size_, bytes);
    if (big_endian_)
        std::reverse(bytes, bytes + size_);
    const double value = value_of(type_, bytes);
    if (!(value >= 0 && value <= 65535) || value != double(int(value)))
        return false;
    out_.push_back(std::uint16_t(value));
    return true;
}

std::string read_labels(ByteView content, bool packed, std::size_t count, SampleType type,
                        bool big_endian, std::vector<std::uint16_t>& out) {
    const std::size_t wanted = count * size_of(type);
    const std::size_t most = packed ? content.size() * gzip_most_ratio : content.size();
    if (wanted > most)
        return "holds less than its header announces";
    // `count` has been checked against the file's size, so this reservation is bounded.
    out.reserve(count);
    LabelCollector collector(type, big_endian, out);
    const auto take = [&](ByteView piece) { return collector.take(piece); };
    const bool whole = packed ? unpack_gzip(content, wanted, take) : take(content.first(wanted));
    if (!collector.good())
        return "holds values that are no labels: images are read as DICOM";
    return whole ? "" : "is damaged or cut off";
}

}  // namespace theatron::cases
