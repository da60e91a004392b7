// SPDX-License-Identifier: Apache-2.0
// Surfaces out of the bytes of STL, PLY and GLB files. Pure, safe for any bytes, bounded by them;
// nothing throws but std::bad_alloc. They run in the process that reads foreign files.
//
// Each hands over its meshes one after another; `take` returns false to stop. The answer is
// Answer::end, or why the file is refused.
#pragma once

#include <functional>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "cases/foreign_files.h"
#include "cases/glb_packed.h"

namespace theatron::cases {

using TakeMesh = std::function<bool(const NamedMesh&)>;

// Text, in any case and also without its end, or binary, also with bytes behind the last facet.
// Normals are not looked at.
Answer read_stl(ByteView file, const TakeMesh& take);

// Text or binary in either order of bytes; elements in any order; polygons and strips of triangles.
Answer read_ply(ByteView file, const TakeMesh& take);

// glTF 2.0 in one file; positions as floating-point numbers or quantized, also packed with
// meshoptimizer. The meshes of one node are one. `extension` names the one that the file needs and
// that is not known, with Answer::extension, or a property, with Answer::property; Draco is one of
// them unless `unpack_draco` is given (glb_packed.h), which makes this as safe as that library is.
Answer read_glb(ByteView file, const TakeMesh& take, std::string& extension,
                glb::UnpackDraco unpack_draco = nullptr);

}  // namespace theatron::cases
