// SPDX-License-Identifier: Apache-2.0
// Surgical instruments, thin and bright. Each lies along +z of its own frame with
// its tip at the origin and its handle at negative z; y is up when it lies flat.
#pragma once

#include "synthetic/mesh.h"

namespace theatron::synthetic {

Mesh make_scalpel();
Mesh make_forceps(float opening);
// One half of scissors or a clamp; `side` is -1 or 1, `angle` its rotation about the joint
// in radians.
Mesh make_scissor_half(int side, float angle);
Mesh make_clamp(float opening);
Mesh make_hand_retractor();
Mesh make_suction();

}  // namespace theatron::synthetic
