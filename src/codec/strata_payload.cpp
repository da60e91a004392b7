// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_payload.h"

#include <cassert>
#include <cstring>

#include "codec/depth_codec.h"
#include "codec/strata_values.h"

namespace theatron::codec::strata {
namespace {

constexpr std::uint8_t version = 1;
enum Flag : std::uint8_t { delta_flag = 1, blend_flag = 2, ranks_flag = 4, lossy_flag = 8 };
constexpr std::uint8_t all_flags = 15;

}  // namespace

std::size_t max_payload_size(Size size) {
    // Per pixel an 11-bit token and 15 further bits. Side information: at most 25
    // binary decisions of 8.1 bits per level, and 33 per value.
    constexpr std::size_t side = std::size_t(coded_contexts) * used_tokens * 26 + max_values * 34;
    constexpr std::size_t region = 3 + max_polygons * (1 + 4 * max_corners);
    return 16 + region + 2 * tap_count + 4 * lane_count + side + 4 * size.area();
}

std::size_t put_payload(const Payload& payload, ByteView side, const Stream& stream,
                        std::span<std::byte> out) {
    std::byte* p = out.data();
    const auto put = [&](auto value) {
        store_le(p, value);
        p += sizeof(value);
    };
    const bool lossy = !payload.tolerance.lossless();
    put(std::uint8_t(DepthCodecId::strata));
    put(version);
    put(std::uint8_t((payload.delta ? delta_flag : 0) | (payload.blend ? blend_flag : 0) |
                     (payload.ranks ? ranks_flag : 0) | (lossy ? lossy_flag : 0)));
    put(std::uint8_t(0));
    put(std::uint16_t(payload.size.width));
    put(std::uint16_t(payload.size.height));
    put(std::uint32_t(side.size()));
    put(std::uint32_t(stream.word_count));
    if (lossy) {
        put(std::uint8_t(payload.tolerance.constant));
        put(std::uint8_t(payload.tolerance.squared));
        put(std::uint8_t(payload.region.size()));
        for (const Polygon& polygon : payload.region) {
            put(std::uint8_t(polygon.size()));
            for (const Corner corner : polygon) {
                put(corner.x);
                put(corner.y);
            }
        }
    }
    for (int i = 0; i < (payload.delta ? tap_count : intra_taps); ++i)
        put(payload.weights[i]);
    for (const std::uint32_t state : stream.states)
        put(state);
    assert(std::size_t(p - out.data()) + side.size() + 2 * stream.word_count <= out.size());
    p = std::copy(side.begin(), side.end(), p);
    for (std::size_t i = 0; i < stream.word_count; ++i)
        put(stream.words[i]);
    return std::size_t(p - out.data());
}

Result<Payload> read_payload(ByteView encoded) {
    ByteReader in(encoded);
    Payload payload;
    const auto codec = in.get<std::uint8_t>();
    const auto got_version = in.get<std::uint8_t>();
    const auto flags = in.get<std::uint8_t>();
    const auto reserved = in.get<std::uint8_t>();
    payload.size.width = in.get<std::uint16_t>();
    payload.size.height = in.get<std::uint16_t>();
    const auto side_size = in.get<std::uint32_t>();
    const auto word_count = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (codec != std::uint8_t(DepthCodecId::strata) || got_version == 0)
        return Status::malformed;
    if (got_version != version)
        return Status::unsupported_version;
    if (flags > all_flags || reserved != 0 || payload.size.width == 0 || payload.size.height == 0)
        return Status::malformed;
    if (!theatron::is_valid(payload.size))
        return Status::too_large;
    payload.delta = flags & delta_flag;
    payload.blend = flags & blend_flag;
    payload.ranks = flags & ranks_flag;

    if (flags & lossy_flag) {
        payload.tolerance.constant = in.get<std::uint8_t>();
        payload.tolerance.squared = in.get<std::uint8_t>();
        payload.region.resize(in.get<std::uint8_t>());
        if (payload.tolerance.lossless() || payload.tolerance.squared > 15 ||
            payload.region.size() > max_polygons)
            return in.ok() ? Status::malformed : Status::truncated;
        for (Polygon& polygon : payload.region) {
            const auto corners = in.get<std::uint8_t>();
            if (in.ok() && (corners < 3 || corners > max_corners))
                return Status::malformed;
            polygon.resize(corners);
            for (Corner& corner : polygon) {
                corner.x = in.get<std::uint16_t>();
                corner.y = in.get<std::uint16_t>();
            }
        }
    }
    for (int i = 0; i < (payload.delta ? tap_count : intra_taps); ++i)
        payload.weights[i] = in.get<std::int16_t>();
    for (std::uint32_t& state : payload.states)
        state = in.get<std::uint32_t>();
    payload.side = in.get_bytes(side_size);
    payload.words = in.get_bytes(2 * std::size_t(word_count));
    if (!in.ok())
        return Status::truncated;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    for (const std::uint32_t state : payload.states) {
        if (state < (1u << 15) || state >= (1u << 31))
            return Status::malformed;
    }
    return payload;
}

}  // namespace theatron::codec::strata
