// SPDX-License-Identifier: Apache-2.0
// Two properties, for intra frames and frames with a reference. Any bytes: decoding
// stays inside its buffers (the sanitizers check). Accepted bytes: encoding the
// result and decoding that gives the same depth.
#include <cstdlib>

#include "codec/strata.h"
#include "codec/test_images.h"

namespace theatron::codec {
namespace {

Reference reference_of(DepthCodec& codec, Size size) {
    const DepthImage image = scene(size, 1);
    Reference reference;
    Bytes encoded(codec.max_encoded_size(size));
    codec.encode(image.view(), nullptr, encoded, &reference);
    return reference;
}

void check(DepthCodec& codec, ByteView input) {
    const Result<Size> size = codec.read_size(input);
    if (!size || size->area() > 1 << 14)
        return;
    const Reference reference = reference_of(codec, *size);
    DepthImage image(*size);
    Reference next;
    if (codec.decode(input, &reference, image.view(), &next) != Status::ok)
        return;
    Bytes again(codec.max_encoded_size(*size));
    Reference sent, received;
    again.resize(codec.encode(image.view(), &next, again, &sent));
    DepthImage twice(*size);
    if (codec.decode(again, &next, twice.view(), &received) != Status::ok || !(twice == image) ||
        sent.memory != received.memory)
        std::abort();
}

}  // namespace
}  // namespace theatron::codec

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto codec = theatron::codec::make_strata({});
    theatron::codec::check(*codec, std::as_bytes(std::span(data, size)));
    return 0;
}
