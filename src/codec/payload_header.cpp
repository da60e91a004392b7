// SPDX-License-Identifier: Apache-2.0
#include "codec/payload_header.h"

namespace theatron::codec {
namespace {

constexpr std::uint8_t version = 1;
constexpr std::uint8_t delta_flag = 1;

}  // namespace

void put_header(const PayloadHeader& header, std::byte* out) {
    store_le(out, std::uint8_t(header.codec));
    store_le(out + 1, version);
    store_le(out + 2, header.delta ? delta_flag : std::uint8_t(0));
    store_le(out + 3, header.parameter);
    store_le(out + 4, std::uint16_t(header.size.width));
    store_le(out + 6, std::uint16_t(header.size.height));
}

Result<PayloadHeader> read_header(ByteView encoded, DepthCodecId codec, bool may_be_delta,
                                  int max_parameter) {
    if (encoded.size() < payload_header_size)
        return Status::truncated;
    const std::byte* in = encoded.data();
    if (load_le<std::uint8_t>(in) != std::uint8_t(codec))
        return Status::malformed;
    if (load_le<std::uint8_t>(in + 1) != version)
        return load_le<std::uint8_t>(in + 1) == 0 ? Status::malformed : Status::unsupported_version;
    const auto flags = load_le<std::uint8_t>(in + 2);
    const auto parameter = load_le<std::uint8_t>(in + 3);
    if (flags > (may_be_delta ? delta_flag : 0) || parameter > max_parameter)
        return Status::malformed;

    const Size size{load_le<std::uint16_t>(in + 4), load_le<std::uint16_t>(in + 6)};
    if (size.width == 0 || size.height == 0)
        return Status::malformed;
    if (!is_valid(size))
        return Status::too_large;
    return PayloadHeader{codec, flags != 0, parameter, size};
}

}  // namespace theatron::codec
