// SPDX-License-Identifier: Apache-2.0
// Draws the labels of a SceneFrame: upright in the picture, on plates, numbers before everything.
#pragma once

#include <optional>
#include <vector>

#include "render/camera_view.h"
#include "render/gl.h"
#include "render/label_place.h"
#include "render/scene_lines.h"
#include "render/text_pass.h"

namespace theatron::render {

// The place of a label's plate in a picture, and of its text's height.
struct LabelPlate {
    Rect plate;  // pixels
    Vec2 place;  // of the label's place in the room, pixels
    double letter = 0;
};

// Where the plates stand; nullopt for a label that is left out: its place is not in the picture, or
// there is no room for its rank. `lengths`: of the texts, in heights of capital letters. Plates of
// numbers cover nothing where that is possible, and are inside of the picture if they fit into it:
// letters are smaller where they would not. Pure.
std::vector<std::optional<LabelPlate>> label_plates(const std::vector<SceneLabel>& labels,
                                                    const std::vector<double>& lengths,
                                                    const CameraView& view, Size picture);

class LabelPass {
public:
    LabelPass();

    // Both eyes have the same plates at their labels' places, or a label would be seen double.
    void place(const std::vector<SceneLabel>& labels, const TextPass& text, const CameraView& first,
               Size picture);
    // The labels of the last place(), in that order. Blending must be on, and the target bound with
    // its viewport. Changes nothing of the depth.
    void draw(const std::vector<SceneLabel>& labels, TextPass& text, const CameraView& view,
              const DrawTarget& target) const;

private:
    Program program_{{"plate.vert"}, {"output.glsl", "plate.frag"}};
    GLint clip_from_picture_ = program_.uniform("clip_from_picture");
    GLint plate_ = program_.uniform("plate");
    GLint ground_ = program_.uniform("ground");
    GLint edge_ = program_.uniform("edge");
    GLint shape_ = program_.uniform("shape");
    VertexArray nothing_;  // the shader makes the corners
    std::vector<std::optional<LabelPlate>> plates_;
};

}  // namespace theatron::render
