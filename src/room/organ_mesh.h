// SPDX-License-Identifier: Apache-2.0
// Surfaces of a case as meshes for drawing.
#pragma once

#include "medical/mesh.h"
#include "render/scene_frame.h"

namespace theatron::room {

// From patient coordinates (LPS, millimetres) to the frame of the organ, in metres of life size: x
// to the patient's left, y to the head, z to the front, `middle_mm` at the origin; and back.
Vec3 organ_from_patient(Vec3 patient_mm, Vec3 middle_mm);
Vec3 patient_from_organ(Vec3 organ_m, Vec3 middle_mm);

render::MeshData make_organ_mesh(const medical::Mesh& mesh, Vec3 middle_mm);

// The colour of a surface that is `color` (sRGB) in a picture; linear.
Vec3 linear_color(Rgb color);

}  // namespace theatron::room
