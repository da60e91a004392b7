// SPDX-License-Identifier: Apache-2.0
// A picture of a face, drawn without a GPU: for files, and for photos whose truth is known. Pure.
#pragma once

#include "face/face_mesh.h"
#include "image/image.h"

namespace theatron::face {

struct FaceLook {
    ColorView texture;  // of the skin; empty: `colors` has its colour
    std::array<Rgb, part_count> colors{};
    Vec3 to_light{0, 0, 1};  // in the head's frame, of length 1
    double shade = 0.4;  // 0: all is as bright as its colour; 1: what turns from the light is black
    Rgb background{40, 44, 48};
};

// Skin as nobody's is, for parts that no photo shows.
std::array<Rgb, part_count> usual_colors();

// Precondition: `size` is not empty.
ColorImage draw_face(const FaceMesh& mesh, const FaceCamera& camera, const FaceLook& look,
                     Size size);

// A camera that sees the whole head from the front; turned by `yaw_degrees` about the neck.
FaceCamera portrait_camera(const FaceMesh& mesh, Size size, double yaw_degrees = 0);

}  // namespace theatron::face
