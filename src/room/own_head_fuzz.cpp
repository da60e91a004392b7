// SPDX-License-Identifier: Apache-2.0
// Any bytes as a face in a session: what is taken for one becomes a head whose triangles have
// corners that are there.
#include <cstdlib>

#include "face/sent_face.h"
#include "room/own_head.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    const Bytes exact(input.begin(), input.end());
    auto read = face::parse_sent_face(exact);
    if (!read)
        return 0;
    room::OwnHead::Textures textures;
    textures[std::size_t(face::Emotion::neutral)] = ColorImage(Size{2, 2});
    const room::OwnHead head(std::move(*read), std::move(textures));
    room::ShownFace shown;
    shown.emotions = {0.5F, 1, 0, 0, 0, 0};
    shown.direct = {1, 1, 0};
    for (const render::MeshData& mesh : head.meshes(shown))
        for (const std::uint32_t corner : mesh.indices)
            if (corner >= mesh.vertices.size())
                std::abort();
    return 0;
}
