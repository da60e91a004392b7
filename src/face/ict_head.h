// SPDX-License-Identifier: Apache-2.0
// The head of ICT-FaceKit Light (University of Southern California, MIT licence) as a morphable
// head. Its files are not part of Theatron; `theatron face model import` reads a folder of them.
//
// A mesh as Wavefront OBJ, in centimetres, whose materials name the parts; and two files of shapes:
// "ICTFKL01", u32 shapes, u32 vertices, u32 0, and of each shape u16 bytes of its name, the name,
// f32 scale, and i16[vertices][3], offsets in centimetres after the scale. Little-endian.
//
// Pure. Safe on any bytes.
#pragma once

#include <string>

#include "face/morph_model.h"

namespace theatron::face {

struct IctFiles {
    std::string_view mesh;
    ByteView expressions, identities;
    std::array<std::uint32_t, landmark_count> landmarks{};  // vertices of the mesh
};

struct IctRead {
    MorphModel model;
    std::string problem;  // empty if `model` holds; else the end of a sentence on the folder
};

// Lashes, the clear cornea, and triangles that only stand for shade round the eyes are left out.
// Vertices of the skin that have several places in its texture are parted.
IctRead read_ict_head(const IctFiles& files);

}  // namespace theatron::face
