// SPDX-License-Identifier: Apache-2.0
// Any bytes: reading ends with meshes whose triangles have their corners, or a reason.
#include <cstdlib>

#include "cases/mesh_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto take = [](const cases::NamedMesh& named) {
        for (const medical::Triangle& t : named.mesh.triangles)
            for (const std::uint32_t corner : t)
                if (corner >= named.mesh.positions.size())
                    std::abort();
        return true;
    };
    std::string said;
    const cases::Answer read = cases::read_gltf(std::as_bytes(std::span(data, size)), take, said);
    switch (read) {
        case cases::Answer::content:
            std::abort();
        case cases::Answer::extension:
        case cases::Answer::property:
        case cases::Answer::version:
        case cases::Answer::other_buffer:
        case cases::Answer::hidden:
        case cases::Answer::end:
            break;
        default:
            if (!said.empty())
                std::abort();
    }
    return 0;
}
