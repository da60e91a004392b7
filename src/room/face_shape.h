// SPDX-License-Identifier: Apache-2.0
// The face of a bust that shows an expression (people.h): the skin of the generated head
// (face/morph_model.h), and on it lids, brows and lips, drawn simply.
//
// In the frame of the head, as figure_meshes.h. Pure.
#pragma once

#include <array>
#include <vector>

#include "face/morph_model.h"
#include "render/scene_frame.h"

namespace theatron::room {

struct FaceMeshes {
    render::MeshData skin;
    render::MeshData whites;  // of the eyes
    render::MeshData dark;    // irises, edges of the lids, brows
    render::MeshData lips;
    render::MeshData mouth;  // the dark between the lips
};

class FaceShape {
public:
    FaceShape();

    FaceMeshes meshes(const face::Channels& channels) const;

private:
    // A place on the skin: a triangle of the model, and the shares of its corners.
    struct Anchor {
        std::array<std::uint32_t, 3> corners{};
        std::array<double, 3> shares{};
    };
    Anchor anchor_at(double x, double y) const;
    static Vec3 on(const Anchor& anchor, const std::vector<float>& skin);

    struct Eye {
        double middle_x = 0;
        // Columns from one corner of the eye to the other; in each the skin at three heights.
        std::vector<std::array<Anchor, 3>> columns;
    };
    struct Lip {
        std::vector<Anchor> outer, inner;  // from one corner of the mouth to the other
    };
    Eye make_eye(double middle_x) const;
    std::vector<std::array<Anchor, 2>> make_brow(double side) const;
    Lip make_lip(bool is_upper) const;

    struct Lids;
    void add_skin(const std::vector<float>& skin, FaceMeshes& out) const;
    void add_eye(const Eye& eye, const Lids& lids, FaceMeshes& out) const;
    void add_brow(const std::vector<std::array<Anchor, 2>>& brow, const std::vector<float>& skin,
                  FaceMeshes& out) const;
    void add_mouth(const std::vector<float>& skin, FaceMeshes& out) const;

    face::MorphModel model_;
    std::array<Eye, 2> eyes_;  // left, right
    std::array<std::vector<std::array<Anchor, 2>>, 2> brows_;
    Lip upper_, lower_;
};

}  // namespace theatron::room
