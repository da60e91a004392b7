// SPDX-License-Identifier: Apache-2.0
// The properties checked by the fuzz targets of all depth codecs.
#pragma once

#include <cstdlib>

#include "codec/depth_codec.h"
#include "codec/test_images.h"

namespace theatron::codec {

// Any bytes: decoding stays inside its buffers (the sanitizers check). Accepted bytes:
// encoding the result and decoding that again gives the same depth, and for a
// `canonical` codec also the same bytes.
inline void fuzz_depth_codec(DepthCodec& codec, ByteView input, bool canonical) {
    const Result<Size> size = codec.read_size(input);
    if (!size || size->area() > 1 << 16)
        return;

    const Reference reference{scene(*size, 1), {}};
    const bool delta = (input[2] & std::byte{1}) != std::byte{0};
    DepthImage image(*size);
    Reference next;
    if (codec.decode(input, &reference, image.view(), &next) != Status::ok)
        return;

    if (!codec.lossless())
        return;
    const Reference* used = delta ? &reference : nullptr;
    Bytes again(codec.max_encoded_size(*size));
    again.resize(codec.encode(image.view(), used, again, &next));
    if (canonical && !std::equal(again.begin(), again.end(), input.begin(), input.end()))
        std::abort();
    DepthImage twice(*size);
    if (codec.decode(again, used, twice.view(), nullptr) != Status::ok || !(twice == image))
        std::abort();
}

}  // namespace theatron::codec
