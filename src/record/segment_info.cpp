// SPDX-License-Identifier: Apache-2.0
#include "record/segment_info.h"

#include <algorithm>
#include <climits>
#include <cstdio>
#include <random>

#include "base/small_letters.h"

namespace theatron::record {
namespace {

constexpr std::string_view magic = "TheatSeg";
constexpr std::uint32_t version = 2;
constexpr std::int64_t max_time_us = std::int64_t(1) << 60;

bool is_plausible(std::int64_t us) {
    return -max_time_us <= us && us <= max_time_us;
}

}  // namespace

Bytes encode_segment_info(const SegmentInfo& info) {
    Bytes bytes;
    bytes.reserve(segment_info_size);
    ByteWriter out(bytes);
    out.put_bytes(as_bytes(magic));
    out.put(version);
    out.put(info.number);
    out.put_bytes(info.recording);
    out.put(std::int64_t(info.clock.utc.time_since_epoch().count()));
    out.put(to_us(info.clock.session));
    return bytes;
}

Result<SegmentInfo> decode_segment_info(ByteView bytes) {
    if (bytes.size() != segment_info_size)
        return Status::size_mismatch;
    ByteReader in(bytes);
    const ByteView found_magic = in.get_bytes(magic.size());
    if (!std::ranges::equal(found_magic, as_bytes(magic)))
        return Status::malformed;
    if (in.get<std::uint32_t>() != version)
        return Status::unsupported_version;
    SegmentInfo info;
    info.number = in.get<std::uint32_t>();
    std::ranges::copy(in.get_bytes(info.recording.size()), info.recording.begin());
    const auto utc_us = in.get<std::int64_t>(), session_us = in.get<std::int64_t>();
    if (info.number < 1 || info.number > max_segments || !is_plausible(utc_us) ||
        !is_plausible(session_us))
        return Status::malformed;
    info.clock = {from_us(session_us), UtcTime(std::chrono::microseconds(utc_us))};
    return info;
}

std::filesystem::path segment_path(const std::filesystem::path& first, std::uint32_t number) {
    if (number <= 1)
        return first;
    char text[16];
    std::snprintf(text, sizeof(text), ".%03u", unsigned(number));
    std::filesystem::path name = first.stem();
    name += text;
    name += first.extension();
    return first.parent_path() / name;
}

std::string name_problem(const std::filesystem::path& first) {
    const std::string ending = in_small_letters(first.extension().string());
    for (const char* other :
         {".mp4", ".m4v", ".mov", ".avi", ".webm", ".wmv", ".mpg", ".mpeg", ".ts", ".flv", ".ogv"})
        if (ending == other)
            return "A recording is a Matroska file, which '" + first.filename().string() +
                   "' does not say; name it '" + first.stem().string() + ".mkv'.";
    const std::size_t longest = segment_path(first, max_segments).filename().string().size();
    if (longest <= NAME_MAX)
        return "";
    return "The name '" + first.filename().string() + "' is too long: it may have " +
           std::to_string(NAME_MAX - (longest - first.filename().string().size())) +
           " bytes, since further files of the recording get a number.";
}

Uid make_uid() {
    std::random_device random;
    Uid uid;
    for (std::byte& b : uid)
        b = std::byte(random());
    return uid;
}

}  // namespace theatron::record
