// SPDX-License-Identifier: Apache-2.0
#include "capture/video_answer.h"

#include <cmath>

#include "geometry/calibration.h"

namespace theatron::capture {

Bytes encode(const VideoAnswer& answer) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(std::uint8_t(answer.kind));
    out.put(std::int64_t(answer.time.count()));
    out.put(std::int32_t(answer.size.width));
    out.put(std::int32_t(answer.size.height));
    out.put_f64(answer.frames_per_second);
    out.put(answer.lost);
    return bytes;
}

Result<VideoAnswer> decode_video_answer(ByteView message, std::size_t shared_bytes) {
    using Kind = VideoAnswer::Kind;
    ByteReader in(message);
    VideoAnswer answer;
    const auto kind = in.get<std::uint8_t>();
    answer.kind = Kind(kind);
    answer.time = Duration(in.get<std::int64_t>());
    answer.size.width = in.get<std::int32_t>();
    answer.size.height = in.get<std::int32_t>();
    answer.frames_per_second = in.get_f64();
    answer.lost = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    // Limits times, so that sums do not overflow.
    constexpr Duration longest = std::chrono::hours(1'000'000);
    if (kind < 1 || kind > std::uint8_t(Kind::names_files) || answer.time < -longest ||
        answer.time > longest || !std::isfinite(answer.frames_per_second))
        return Status::malformed;
    if (answer.kind != Kind::opened)
        return answer;
    if (!is_valid(answer.size) || answer.size.area() > max_color_pixels ||
        video_bytes(answer.size) > shared_bytes)
        return Status::too_large;
    return answer;
}

}  // namespace theatron::capture
