// SPDX-License-Identifier: Apache-2.0
// Samples of label maps as they come out of files, packed or not. Only for this module.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/bytes.h"

namespace theatron::cases {

// Unpacks gzip and calls `take` for each piece, until `take` returns false or all `wanted` bytes
// have been passed; never unpacks more. False: damaged, or fewer bytes than wanted.
bool unpack_gzip(ByteView packed, std::size_t wanted, const std::function<bool(ByteView)>& take);

// No gzip stream unpacks to more than this many times its size.
inline constexpr std::size_t gzip_most_ratio = 1040;

enum class SampleType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
std::size_t size_of(SampleType type);

// Takes bytes in pieces of any size and makes labels of them.
class LabelCollector {
public:
    LabelCollector(SampleType type, bool big_endian, std::vector<std::uint16_t>& out)
        : type_(type), size_(size_of(type)), big_endian_(big_endian), out_(out) {}

    // False at a sample that is no label: not whole, below 0 or above 65535.
    bool take(ByteView piece);
    bool good() const { return good_; }

private:
    bool add(const std::byte* sample);

    SampleType type_;
    std::size_t size_;
    bool big_endian_;
    std::vector<std::uint16_t>& out_;
    std::byte part_[8];
    std::size_t part_size_ = 0;
    bool good_ = true;
};

// Reads `count` samples out of `content`. Returns the problem as the end of a sentence, or nothing.
std::string read_labels(ByteView content, bool packed, std::size_t count, SampleType type,
                        bool big_endian, std::vector<std::uint16_t>& out);

}  // namespace theatron::cases
