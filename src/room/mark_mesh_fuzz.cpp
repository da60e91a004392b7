// SPDX-License-Identifier: Apache-2.0
// Any bytes that are a mark: it can be drawn.
#include <cmath>
#include <cstdlib>

#include "room/mark_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const std::optional<session::Mark> mark = session::decode_mark(bytes);
    if (!mark)
        return 0;
    const render::MeshData mesh = room::make_mark_mesh(*mark);
    for (const render::MeshData::Vertex& v : mesh.vertices)
        if (!std::isfinite(v.px + v.py + v.pz + v.nx + v.ny + v.nz))
            std::abort();
    for (const std::uint32_t i : mesh.indices)
        if (i >= mesh.vertices.size())
            std::abort();
    return 0;
}
