// SPDX-License-Identifier: Apache-2.0
// Places of the nodes of a glTF file. Only for glb_reader.cpp.
#pragma once

#include <array>

#include "cases/glb_accessor.h"
#include "geometry/vec.h"

namespace theatron::cases::glb {

// Columns as glTF has them.
using Matrix = std::array<double, 16>;

Matrix product(const Matrix& a, const Matrix& b);
Vec3 placed(const Matrix& m, Vec3 p);
bool is_mirrored(const Matrix& m);
// The place of a node in its parent, by its matrix or by translation, rotation and scale. Returns
// the name of a property that cannot be; nothing where all are good.
const char* read_place(const Json& node, Matrix& out);

}  // namespace theatron::cases::glb
