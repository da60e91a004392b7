// SPDX-License-Identifier: Apache-2.0
// Triangle meshes and the shapes they are built from.
//
// Triangles are counter-clockwise seen from outside. Each vertex has a `texture` coordinate:
// a position in the object's own frame, from which its material computes the pattern, so that
// patterns move with objects. For materials with printed pictures it is (u, v, picture number).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "synthetic/operating_room.h"
#include "synthetic/vec3f.h"

namespace theatron::synthetic {

// The appearance of a surface; see materials.h.
enum class Look : std::uint8_t;

struct Triangle {
    std::uint32_t a = 0, b = 0, c = 0;
    Look look{};
};

struct Mesh {
    std::vector<F3> positions;
    std::vector<F3> normals;
    std::vector<F3> textures;
    std::vector<float> openness;  // share of ambient light that arrives (ambient occlusion)
    std::vector<Triangle> triangles;

    std::uint32_t add_vertex(F3 position, F3 normal, F3 texture) {
        positions.push_back(position);
        normals.push_back(normal);
        textures.push_back(texture);
        openness.push_back(1);
        return std::uint32_t(positions.size() - 1);
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Look look) {
        triangles.push_back({a, b, c, look});
    }
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Look look) {
        add_triangle(a, b, c, look);
        add_triangle(a, c, d, look);
    }
    void append(const Mesh& other);
    void append(const Mesh& other, const Affine& placed);
};

// Recomputes smooth normals from the triangles, over shared vertices.
void smooth_normals(Mesh& mesh);

// Splits all triangles with an edge longer than `longest`. Under lens distortion only short
// edges can be drawn as straight lines.
void split_long_edges(Mesh& mesh, float longest);

// A box around the origin with edges rounded by `bevel`.
Mesh make_box(F3 size, float bevel, Look look);

// A surface over the unit square, `nu` x `nv` cells, with smooth normals. The texture
// coordinate is the position.
Mesh make_sheet(int nu, int nv, const std::function<F3(float u, float v)>& position, Look look);

// A tube along `path` with these radii (one for all, or one each), round, with
// rounded ends. `squash` scales the radius along the tube's local up.
Mesh make_tube(const std::vector<F3>& path, const std::vector<float>& radii, int sides, Look look,
               float squash = 1, F3 up = {0, 1, 0});

// A solid of revolution: `profile` (radius, height) from bottom to top, about the y axis.
Mesh make_lathe(const std::vector<std::pair<float, float>>& profile, int sides, Look look);

// A flat rectangle in the x-y plane, facing +z, showing picture `number` upright.
Mesh make_picture(float width, float height, int number, Look look);

Mesh make_cylinder(float radius, float height, int sides, Look look);  // on the x-z plane
Mesh make_ball(F3 radii, int sides, Look look);

}  // namespace theatron::synthetic
