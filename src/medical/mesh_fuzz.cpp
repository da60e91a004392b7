// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. Bytes that are accepted: encoding gives the same again,
// and the shape can be measured.
#include <cstdlib>

#include "medical/mesh_measures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const Result<medical::Mesh> mesh = medical::decode_mesh(bytes);
    if (!mesh)
        return 0;
    const Bytes again = medical::encode_mesh(*mesh);
    if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()))
        std::abort();
    if (medical::shape_of(*mesh).manifold && !medical::shape_of(*mesh).closed)
        std::abort();
    return 0;
}
