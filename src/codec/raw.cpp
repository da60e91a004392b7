// SPDX-License-Identifier: Apache-2.0
#include "codec/raw.h"

#include <cassert>
#include <cstring>

#include "codec/payload_header.h"

namespace theatron::codec::raw {

std::size_t encoded_size(Size size) {
    return payload_header_size + 2 * size.area();
}

std::size_t encode(DepthView depth, std::span<std::byte> out) {
    assert(is_valid(depth.size) && out.size() >= encoded_size(depth.size));
    put_header({.codec = DepthCodecId::raw, .size = depth.size}, out.data());
    const std::size_t row_bytes = 2 * std::size_t(depth.size.width);
    std::byte* to = out.data() + payload_header_size;
    for (int y = 0; y < depth.size.height; ++y, to += row_bytes)
        std::memcpy(to, depth.row(y), row_bytes);
    return encoded_size(depth.size);
}

Result<Size> read_size(ByteView encoded) {
    const auto header = read_header(encoded, DepthCodecId::raw, false);
    if (!header)
        return header.error();
    return header->size;
}

Status decode(ByteView encoded, MutableDepthView out) {
    const auto size = read_size(encoded);
    if (!size)
        return size.error();
    if (*size != out.size)
        return Status::size_mismatch;
    if (encoded.size() < encoded_size(*size))
        return Status::truncated;
    if (encoded.size() > encoded_size(*size))
        return Status::trailing_bytes;
    const std::size_t row_bytes = 2 * std::size_t(size->width);
    const std::byte* from = encoded.data() + payload_header_size;
    for (int y = 0; y < size->height; ++y, from += row_bytes)
        std::memcpy(out.row(y), from, row_bytes);
    return Status::ok;
}

}  // namespace theatron::codec::raw
