// SPDX-License-Identifier: Apache-2.0
// A piece of furniture as closed surfaces of some materials, and the shapes it is composed of.
//
// All shapes are closed and their normals point outside. Metres; y is up. No GL.
#pragma once

#include <vector>

#include "furniture/material.h"
#include "geometry/vec.h"
#include "render/scene_frame.h"

namespace theatron::furniture {

struct Model {
    struct Part {
        Material material;
        render::MeshData mesh;
    };
    std::vector<Part> parts;  // at most one of each material

    // The part of this material, made if there is none. Valid until the next one is made.
    render::MeshData& of(Material material);

    // A box whose edges are rounded off by `bevel`, if that is more than 6 mm; large sides are
    // divided, so that light at corners of triangles (baked_light.h) has somewhere to be.
    void box(Material material, Vec3 low, Vec3 high, double bevel = 0.004);
    // The same by its middle, which is turned by `pose`.
    void turned_box(Material material, const Pose& pose, Vec3 size, double bevel = 0.004);
    // A round rod along these points (at least two, no two equal), with flat ends.
    void rod(Material material, const std::vector<Vec3>& points, double radius, int sides = 6);
    // A body of revolution about the y axis through `place`. The profile (radius, height) goes from
    // the axis below, outside, to the axis above; its first and last radius are 0.
    void round(Material material, Vec3 place, const std::vector<Vec2>& profile, int sides = 12);
    // A body of revolution in the frame of `pose`, about its y axis.
    void turned_round(Material material, const Pose& pose, const std::vector<Vec2>& profile,
                      int sides = 12);
    // An upright cylinder, its ends rounded off by `bevel` as those of a box.
    void cylinder(Material material, Vec3 bottom, double radius, double height,
                  double bevel = 0.003, int sides = 12);

    void add(const Model& other, const Pose& place);
};

struct Box {
    Vec3 low, high;
};
// Around all corners; needs a model with at least one.
Box bounds(const Model& model);

// Appends `part` at `place`.
void append_at(render::MeshData& mesh, const render::MeshData& part, const Pose& place);

}  // namespace theatron::furniture
