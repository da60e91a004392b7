// SPDX-License-Identifier: Apache-2.0
#include "filter/background.h"

#include <algorithm>
#include <cmath>

namespace theatron::filter {
namespace {

constexpr std::uint32_t magic = 0x47424854;  // "THBG"
constexpr std::uint8_t version = 1;

constexpr std::size_t header_size = 4 + 1 + 3 + 2 + 2 + 4 + 8;

}  // namespace

bool add_frame(Background& background, DepthView frame) {
    DepthImage& nearest = background.nearest;
    if (background.frames == 0) {
        nearest.resize(frame.size);
        std::fill(nearest.pixels.begin(), nearest.pixels.end(), std::uint16_t(0));
    }
    if (nearest.size != frame.size)
        return false;
    ++background.frames;
    for (int y = 0; y < frame.size.height; ++y) {
        const std::uint16_t* in = frame.row(y);
        std::uint16_t* out = nearest.view().row(y);
        // Subtracting one turns 0, no measurement, into the largest number.
        for (int x = 0; x < frame.size.width; ++x)
            out[x] =
                std::uint16_t(std::min(std::uint16_t(out[x] - 1), std::uint16_t(in[x] - 1)) + 1);
    }
    return true;
}

Bytes encode_background(const Background& background) {
    Bytes bytes;
    bytes.reserve(header_size + 2 * background.nearest.pixels.size());
    ByteWriter out(bytes);
    out.put(magic);
    out.put(version);
    for (int i = 0; i < 3; ++i)
        out.put(std::uint8_t(0));
    out.put(std::uint16_t(background.nearest.size.width));
    out.put(std::uint16_t(background.nearest.size.height));
    out.put(std::uint32_t(background.frames));
    out.put_f64(background.depth_unit_mm);
    for (const std::uint16_t pixel : background.nearest.pixels)
        out.put(pixel);
    return bytes;
}

Result<Background> decode_background(ByteView bytes) {
    ByteReader in(bytes);
    if (in.get<std::uint32_t>() != magic)
        return in.ok() ? Status::malformed : Status::truncated;
    if (const auto v = in.get<std::uint8_t>(); in.ok() && v != version)
        return v == 0 ? Status::malformed : Status::unsupported_version;
    bool zero = true;
    for (int i = 0; i < 3; ++i)
        zero &= in.get<std::uint8_t>() == 0;
    const int width = in.get<std::uint16_t>(), height = in.get<std::uint16_t>();
    const auto frames = in.get<std::uint32_t>();
    const double unit = in.get_f64();
    if (!in.ok())
        return Status::truncated;
    const Size size{width, height};
    if (width > max_side || height > max_side)
        return Status::too_large;
    if (!zero || !is_valid(size) || frames == 0 || frames > 1'000'000 || !std::isfinite(unit) ||
        unit < 1e-3 || unit > 1e3)
        return Status::malformed;
    const ByteView pixels = in.get_bytes(2 * size.area());
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;

    Background background{DepthImage(size), unit, int(frames)};
    for (std::size_t i = 0; i < size.area(); ++i)
        background.nearest.pixels[i] = load_le<std::uint16_t>(pixels.data() + 2 * i);
    return background;
}

}  // namespace theatron::filter
