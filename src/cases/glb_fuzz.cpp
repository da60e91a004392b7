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
    std::string extension;
    const cases::Answer read =
        cases::read_glb(std::as_bytes(std::span(data, size)), take, extension);
    const bool is_named = read == cases::Answer::extension || read == cases::Answer::property;
    if (read == cases::Answer::content || is_named != !extension.empty())
        std::abort();
    return 0;
}
