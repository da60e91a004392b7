// SPDX-License-Identifier: Apache-2.0
// Answers of a reader that a malicious file controls: decoding must stay inside their bytes. The
// first byte chooses between an image, identifiers and a mesh.
#include <cstdlib>

#include "cases/foreign_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    if (size == 0)
        return 0;
    const ByteView bytes = std::as_bytes(std::span(data, size)).subspan(1);
    if (data[0] & 1) {
        const Result<cases::DicomSlice> slice = cases::decode_dicom_slice(bytes);
        if (slice && slice->samples.size() != std::size_t(slice->columns * slice->rows))
            std::abort();
    } else if (data[0] & 2) {
        const auto identifiers = cases::decode_identifiers(bytes);
        if (identifiers && identifiers->size() > cases::max_identifiers)
            std::abort();
    } else {
        const Result<cases::NamedMesh> mesh = cases::decode_named_mesh(bytes);
        if (mesh)
            for (const medical::Triangle& t : mesh->mesh.triangles)
                for (const std::uint32_t v : t)
                    if (v >= mesh->mesh.positions.size())
                        std::abort();
    }
    return 0;
}
