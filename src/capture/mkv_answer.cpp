// SPDX-License-Identifier: Apache-2.0
#include "capture/mkv_answer.h"

#include <cmath>

namespace theatron::capture {
namespace {

void put_text(ByteWriter& out, std::string_view text) {
    out.put(std::uint32_t(text.size()));
    out.put_bytes(as_bytes(text));
}

std::string get_text(ByteReader& in, std::size_t most, bool& fits) {
    const auto size = in.get<std::uint32_t>();
    fits = fits && size <= most;
    const ByteView bytes = in.get_bytes(fits ? size : 0);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void put_size(ByteWriter& out, Size size) {
    out.put(std::int32_t(size.width));
    out.put(std::int32_t(size.height));
}

Size get_size(ByteReader& in) {
    const auto width = in.get<std::int32_t>();
    return {width, in.get<std::int32_t>()};
}

}  // namespace

Bytes encode(const MkvAnswer& answer) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put(std::uint8_t(answer.kind));
    out.put(std::int64_t(answer.time.count()));
    out.put(answer.bytes);
    return bytes;
}

Result<MkvAnswer> decode_mkv_answer(ByteView message, std::size_t shared_bytes) {
    ByteReader in(message);
    MkvAnswer answer;
    const auto kind = in.get<std::uint8_t>();
    answer.kind = MkvAnswer::Kind(kind);
    answer.time = Duration(in.get<std::int64_t>());
    answer.bytes = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    // Limits times, so that sums do not overflow.
    constexpr Duration longest = std::chrono::hours(1'000'000);
    if (kind < 1 || kind > std::uint8_t(MkvAnswer::Kind::infrared_only) ||
        answer.bytes > shared_bytes || answer.time < -longest || answer.time > longest)
        return Status::malformed;
    return answer;
}

Bytes encode(const MkvDescription& description) {
    Bytes bytes;
    ByteWriter out(bytes);
    put_size(out, description.depth);
    put_size(out, description.color);
    out.put_f64(description.frames_per_second);
    put_text(out, description.other_color);
    put_text(out, description.calibration);
    return bytes;
}

Result<MkvDescription> decode_mkv_description(ByteView bytes) {
    ByteReader in(bytes);
    MkvDescription description;
    description.depth = get_size(in);
    description.color = get_size(in);
    description.frames_per_second = in.get_f64();
    bool fits = true;
    description.other_color = get_text(in, max_codec_name, fits);
    description.calibration = get_text(in, max_calibration_bytes, fits);
    if (!fits)
        return Status::malformed;
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    if (!is_valid(description.depth) ||
        (description.color != Size{} && !is_valid(description.color)) ||
        !std::isfinite(description.frames_per_second))
        return Status::malformed;
    return description;
}

}  // namespace theatron::capture
