// SPDX-License-Identifier: Apache-2.0
// Surfaces out of the bytes of STL, PLY and glTF files. Pure, safe for any bytes, bounded by them;
// nothing throws but std::bad_alloc. They run in the process that reads foreign files.
//
// Each hands over its meshes one after another; `take` returns false to stop. The answer is
// Answer::end, or why the file is refused.
#pragma once

#include <functional>

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "cases/foreign_files.h"
#include "cases/glb_buffers.h"
#include "cases/glb_packed.h"

namespace theatron::cases {

using TakeMesh = std::function<bool(const NamedMesh&)>;

// Text, in any case and also without its end, or binary, also with bytes behind the last facet.
// Normals are not looked at.
Answer read_stl(ByteView file, const TakeMesh& take);

// Text or binary in either order of bytes; elements in any order; polygons and strips of triangles.
Answer read_ply(ByteView file, const TakeMesh& take);

// glTF 2.0, in one piece (GLB) or as JSON with its buffers within it or beside it; positions as
// floating-point numbers or quantized, also packed with meshoptimizer. The meshes of one node are
// one; hidden ones (KHR_node_visibility) are left out.
//
// `said` is what the answer speaks of: an extension, a property, a version, the name of a file
// that is needed (other_buffer), or with end and hidden the names of hidden meshes, one a line.
// `find_beside` may be empty: then each file beside is one that is not there. Draco is an extension
// that is not known unless `unpack_draco` is given (glb_packed.h), which makes this as safe as that
// library is.
Answer read_gltf(ByteView file, const TakeMesh& take, std::string& said,
                 const glb::FindBeside& find_beside = {}, glb::UnpackDraco unpack_draco = nullptr);

}  // namespace theatron::cases
