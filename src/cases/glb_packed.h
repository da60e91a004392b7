// SPDX-License-Identifier: Apache-2.0
// Unpacks corners and triangles of glTF files that other programs packed, with the libraries of
// those formats. Bounded by what the file announces.
//
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0:
// Khronos/KHR_draco_mesh_compression, Vendor/EXT_meshopt_compression,
// Khronos/KHR_meshopt_compression
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "geometry/vec.h"

namespace theatron::cases::glb {

// Corners and triangles as a file stores them.
struct RawMesh {
    std::vector<Vec3> corners;  // as stored: whole numbers are not yet parts of the largest one
    std::vector<std::uint32_t> indices;
};

// `position`: the number that the file gives to the corners. Nothing where the bytes are no such
// mesh. The library is not safe for any bytes, so this runs in the sandbox alone; it throws
// std::bad_alloc where they announce more than there is memory.
std::optional<RawMesh> unpack_draco(ByteView packed, std::uint32_t position);
using UnpackDraco = decltype(&unpack_draco);

// As the extension's object has them. Together at most max_unpacked_view_bytes.
struct MeshoptView {
    std::string mode, filter;
    std::size_t count = 0, stride = 0;
};
inline constexpr std::size_t max_unpacked_view_bytes = std::size_t(256) << 20;

// The corners have the newer form of KHR_meshopt_compression, which the library does not unpack.
bool needs_newer_meshopt(ByteView packed, const MeshoptView& about);

// Safe for any bytes. Nothing where they are damaged, or packed in a way that is not known.
std::optional<Bytes> unpack_meshopt(ByteView packed, const MeshoptView& about);

}  // namespace theatron::cases::glb
