// SPDX-License-Identifier: Apache-2.0
// Samples of label maps as they come out of files, packed or not. Only for this module.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "cases/inflate.h"

namespace theatron::cases {

enum class SampleType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
std::size_t size_of(SampleType type);

// How samples lie in a file, and which of them count.
struct SampleLayout {
    SampleType type = SampleType::u8;
    bool big_endian = false;
    double slope = 1, intercept = 0;  // a label is slope * sample + intercept
    std::size_t skipped_bytes = 0;    // before the first sample, after unpacking
    // One of every `step` runs of `run` samples is taken, that numbered `first`; `skipped` samples
    // come before.
    std::size_t first = 0, step = 1, run = 1, skipped = 0;
    std::size_t count = 0;  // samples that are taken

    std::size_t bytes() const { return skipped_bytes + (skipped + count * step) * size_of(type); }
};

struct ReadSamples {
    std::string problem;  // the end of a sentence; empty if all samples were read
    bool is_other_content = false;
};

// Takes bytes in pieces of any size and makes labels of them: whole numbers from 0 to 65535, also
// where rounding left them a thousandth beside one; a sample that is no number (NaN) is 0.
class LabelCollector {
public:
    LabelCollector(const SampleLayout& layout, std::vector<std::uint16_t>& out)
        : layout_(layout), size_(size_of(layout.type)), to_skip_(layout.skipped_bytes), out_(out) {}

    // False at a sample that is no label.
    bool take(ByteView piece);
    bool good() const { return good_; }
    // False if `value` is no label.
    bool add_value(double value);

private:
    bool add(const std::byte* sample);

    const SampleLayout& layout_;
    std::size_t size_, to_skip_, at_ = 0;
    std::vector<std::uint16_t>& out_;
    std::byte part_[8];
    std::size_t part_size_ = 0;
    bool good_ = true;
};

// Reads samples out of `content`, which is packed or not.
ReadSamples read_labels(ByteView content, std::optional<Packing> packing,
                        const SampleLayout& layout, std::vector<std::uint16_t>& out);

// The same of numbers as text.
ReadSamples read_label_text(ByteView content, const SampleLayout& layout,
                            std::vector<std::uint16_t>& out);

}  // namespace theatron::cases
