// SPDX-License-Identifier: Apache-2.0
// Meshes composed of simpler ones.
#pragma once

#include "render/scene_frame.h"

namespace theatron::room {

// Appends `part`, scaled along each axis (factors above 0) and then moved. Metres.
void append(render::MeshData& mesh, const render::MeshData& part, Vec3 scale, Vec3 place);

}  // namespace theatron::room
