// SPDX-License-Identifier: Apache-2.0
// A recording is a chain of segments, each a file of its own. SegmentInfo is the
// place of a file in this chain and the meaning of the session's clock in it.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"
#include "base/utc.h"

namespace theatron::record {

using Uid = std::array<std::byte, 16>;

// The session's clock and the wall's, read at the same instant.
struct ClockPair {
    TimePoint session;
    UtcTime utc;
    bool operator==(const ClockPair&) const = default;
};

struct SegmentInfo {
    Uid recording{};           // the same in all segments of a recording
    std::uint32_t number = 1;  // of the segment, from 1
    // Block times count from `clock.session`.
    ClockPair clock;
    bool operator==(const SegmentInfo&) const = default;
};

inline constexpr std::size_t segment_info_size = 48;
// Names have room for more digits, but more changes of cameras are not expected.
inline constexpr std::uint32_t max_segments = 9999;

// Layout of docs/formats/recording.md.
Bytes encode_segment_info(const SegmentInfo& info);
// Safe for untrusted input.
Result<SegmentInfo> decode_segment_info(ByteView bytes);

// The file of segment `number` of a recording that begins in `first`: "a.mkv", "a.002.mkv".
std::filesystem::path segment_path(const std::filesystem::path& first, std::uint32_t number);

// One sentence if the name says another format or is too long for later segments; else empty.
std::string name_problem(const std::filesystem::path& first);

// 128 random bits.
Uid make_uid();

}  // namespace theatron::record
