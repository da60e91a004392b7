// SPDX-License-Identifier: Apache-2.0
// The shapes of a person's figure (people.h): a bust in the clothes of an operating room, gloved
// hands, and a plate for people of whom only the view is known.
//
// Frames: the head's origin is between the eyes, x to the person's right, y up, -z forward; a
// hand's -z points where its fingers point. Metres.
#pragma once

#include <array>

#include "render/scene_frame.h"

namespace theatron::room {

// Head, cap, mask and eyes turn with the head, the others with the body.
struct BustMeshes {
    render::MeshData head;
    render::MeshData back;  // of the head alone, behind a face that is drawn (face_shape.h)
    render::MeshData cap;   // over the hair
    render::MeshData mask;  // over mouth and nose; seen from before and from the sides
    render::MeshData eyes;  // two dark ovals
    render::MeshData neck;
    render::MeshData gown;    // shoulders and chest
    render::MeshData collar;  // of the gown
};
BustMeshes bust_meshes();
// BustMeshes::back behind another face: at each of back_heights it has half of this width. It
// begins below the face, by this angle in radians.
using BackSizes = std::array<double, 6>;
inline constexpr BackSizes back_heights{-0.12, -0.105, -0.07, -0.03, 0.01, 0.06},
    usual_back_widths{0.03, 0.044, 0.0625, 0.0705, 0.0695, 0.067};
render::MeshData back_mesh(const BackSizes& half_widths, double below = 0);
// The body below a head turns about the vertical alone, around this point of the head's frame.
inline constexpr Vec3 neck_pivot{0, -0.1, 0.03};

struct HandMeshes {
    render::MeshData glove, cuff;
};
enum class Side { left, right };
// `points`: the index finger is stretched, the others are bent.
HandMeshes hand_meshes(Side side, bool points);

// A disc in the frame of SceneText (x right, y down, z away from the reader), seen from before.
render::MeshData disc_mesh(double radius_m);
// A cone whose tip points along -z; the origin is in its middle.
render::MeshData view_cone_mesh();

}  // namespace theatron::room
