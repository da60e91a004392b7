// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh of ICT-FaceKit Light, and as its shapes: what is read can be written as a
// model and read again.
#include <cstdlib>

#include "face/ict_head.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    // A zero parts the mesh from the shapes.
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::size_t end = std::min(text.find('\0'), text.size());
    const std::string mesh(text.substr(0, end));
    const auto rest = std::as_bytes(std::span(data, size)).subspan(std::min(end + 1, size));
    const Bytes shapes(rest.begin(), rest.end());
    const face::IctRead read = face::read_ict_head({mesh, shapes, shapes, {}});
    if (read.problem.empty() && !face::parse_model(face::model_bytes(read.model)))
        std::abort();
    return 0;
}
