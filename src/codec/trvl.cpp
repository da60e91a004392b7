// SPDX-License-Identifier: Apache-2.0
#include "codec/trvl.h"

#include <cassert>

#include "codec/payload_header.h"
#include "codec/rows.h"
#include "codec/rvl.h"

namespace theatron::codec::trvl {

std::size_t max_encoded_size(Size size) {
    return payload_header_size + rvl::max_encoded_runs(size.area());
}

std::size_t encode(DepthView depth, DepthView reference, std::span<std::uint16_t> scratch,
                   std::span<std::byte> out) {
    const bool delta = reference.pixels != nullptr;
    assert(is_valid(depth.size) && (!delta || reference.size == depth.size));
    assert(scratch.size() >= depth.size.area() && out.size() >= max_encoded_size(depth.size));

    const MutableDepthView coded{scratch.data(), depth.size};
    if (delta)
        subtract_rows(depth, reference, coded);
    else
        copy_rows(depth, coded);
    put_header({.codec = DepthCodecId::trvl, .delta = delta, .size = depth.size}, out.data());
    return payload_header_size +
           rvl::encode_runs(scratch.first(depth.size.area()), out.subspan(payload_header_size));
}

Result<Size> read_size(ByteView encoded) {
    const auto header = read_header(encoded, DepthCodecId::trvl, true);
    if (!header)
        return header.error();
    return header->size;
}

Status decode(ByteView encoded, DepthView reference, std::span<std::uint16_t> scratch,
              MutableDepthView out) {
    const auto header = read_header(encoded, DepthCodecId::trvl, true);
    if (!header)
        return header.error();
    if (header->size != out.size)
        return Status::size_mismatch;
    if (header->delta && (reference.pixels == nullptr || reference.size != out.size))
        return Status::missing_reference;

    assert(scratch.size() >= out.size.area());
    const MutableDepthView coded{scratch.data(), out.size};
    const Status status =
        rvl::decode_runs(encoded.subspan(payload_header_size), scratch.first(out.size.area()));
    if (status != Status::ok)
        return status;
    if (header->delta)
        add_rows(coded, reference, out);
    else
        copy_rows(coded, out);
    return Status::ok;
}

}  // namespace theatron::codec::trvl
