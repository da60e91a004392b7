// SPDX-License-Identifier: Apache-2.0
// The light that falls on matt surfaces of a furnished room: ceiling, walls and floor from all
// around, the ceiling panel above the table, and the two lamps of the table; with soft shadows.
//
// Computed once for each room, on the processor. Linear; 1 is white paper's usual brightness.
#pragma once

#include <vector>

#include "furniture/furnish.h"
#include "furniture/voxels.h"
#include "image/image.h"

namespace theatron::furniture {

class BakedLight {
public:
    // To be made by step().
    explicit BakedLight(const Extent& extent);
    // Makes it at once.
    BakedLight(const Extent& extent, const std::vector<Piece>& pieces);

    // True once it is made, of the same pieces each time. Each call takes a few milliseconds.
    bool step(const std::vector<Piece>& pieces);

    // On a surface at `place` with this normal (unit length).
    double at(Vec3 place, Vec3 normal) const;

private:
    double from_around(Vec3 place, Vec3 normal) const;
    double from_lamps(Vec3 place, Vec3 normal) const;
    // Where walls, floor and ceiling meet it is darker.
    double open_corner(Vec3 place, Vec3 normal) const;

    Extent extent_;
    bool has_panel_ = false, has_lamps_ = false;
    Voxels voxels_;
    std::size_t pieces_done_ = 0;
};

// From light to a picture's colour, bright parts compressed: the same as in scene.frag.
Rgb shown(Vec3 light);

// Appends a piece, its corners in the colours that they have in this light.
void append_baked(render::MeshData& all, const Piece& piece, const BakedLight& light);
// All pieces as one mesh in the room, its corners in the colours that they have in this light.
render::MeshData baked_mesh(const std::vector<Piece>& pieces, const BakedLight& light);

}  // namespace theatron::furniture
