// SPDX-License-Identifier: Apache-2.0
#include "cases/sample_stream.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "cases/text_words.h"

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

std::size_t size_of(SampleType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[std::size_t(type)];
}

bool LabelCollector::take(ByteView piece) {
    const std::size_t skip = std::min(to_skip_, piece.size());
    to_skip_ -= skip;
    piece = piece.subspan(skip);
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
    if (layout_.big_endian)
        std::reverse(bytes, bytes + size_);
    return add_value(value_of(layout_.type, bytes));
}

bool LabelCollector::add_value(double value) {
    const std::size_t at = at_++;
    if (at < layout_.skipped ||
        (at - layout_.skipped) / layout_.run % layout_.step != layout_.first)
        return true;
    value = std::isnan(value) ? 0 : layout_.slope * value + layout_.intercept;
    constexpr double rounding = 1e-3;
    const double whole = std::round(value);
    if (!(whole >= 0 && whole <= 65535) || std::abs(value - whole) > rounding)
        return good_ = false;
    out_.push_back(std::uint16_t(whole));
    return true;
}

namespace {

ReadSamples result_of(bool is_good, std::size_t found, std::size_t wanted, bool damaged) {
    if (!is_good)
        return {
            "holds values that are no labels; if it is an image, add it as DICOM, as which alone "
            "images are read",
            true};
    if (damaged)
        return {"is damaged or cut off"};
    if (found < wanted)
        return {"holds less than its header announces: it is cut off or damaged"};
    return {};
}

}  // namespace

ReadSamples read_labels(ByteView content, std::optional<Packing> packing,
                        const SampleLayout& layout, std::vector<std::uint16_t>& out) {
    const std::size_t wanted = layout.bytes();
    const std::size_t most = packing ? content.size() * most_ratio(*packing) : content.size();
    if (wanted > most)
        return {"holds less than its header announces: it is cut off or damaged"};
    // A bomb of bzip2 may hold so much more than it has bytes that this would take all memory.
    if (!packing || *packing != Packing::bzip2)
        out.reserve(layout.count);
    LabelCollector collector(layout, out);
    const auto take = [&](ByteView piece) { return collector.take(piece); };
    bool damaged = false;
    if (packing)
        unpack(content, *packing, wanted, take, damaged);
    else
        take(content.first(wanted));
    return result_of(collector.good(), out.size(), layout.count, damaged);
}

ReadSamples read_label_text(ByteView content, const SampleLayout& layout,
                            std::vector<std::uint16_t>& out) {
    // Each number has a digit and a blank behind it.
    if (layout.count > content.size())
        return {"holds less than its header announces: it is cut off or damaged"};
    out.reserve(layout.count);
    LabelCollector collector(layout, out);
    TextWords words(content);
    while (out.size() < layout.count && !words.at_end()) {
        const std::string_view word = words.next();
        double value = 0;
        if (word.empty())
            break;
        if (!to_number(word, value))
            return {"is damaged: its samples are no numbers"};
        if (!collector.add_value(value))
            break;
    }
    return result_of(collector.good(), out.size(), layout.count, false);
}

}  // namespace theatron::cases
