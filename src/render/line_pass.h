// SPDX-License-Identifier: Apache-2.0
// Draws the lines of a SceneFrame.
#pragma once

#include <vector>

#include "render/camera_view.h"
#include "render/gl.h"
#include "render/scene_frame.h"

namespace theatron::render {

// Calls use(vertex, fragment) with the shaders of lines.
template <class Use>
auto line_files(Use use) {
    return use(ShaderFiles{"line.vert"}, ShaderFiles{"output.glsl", "line.frag"});
}

class LinePass {
public:
    LinePass();

    // Blending must be on, and the target bound with its viewport. Writes no depth.
    void draw(const std::vector<SceneLine>& lines, const CameraView& view,
              const DrawTarget& target) const;

private:
    Program program_;
    GLint clip_from_line_ = program_.uniform("clip_from_line");
    GLint picture_ = program_.uniform("picture");
    GLint origin_ = program_.uniform("origin");
    GLint pixels_per_slope_ = program_.uniform("pixels_per_slope");
    GLint least_radius_ = program_.uniform("least_radius");
    GLint outline_ = program_.uniform("outline");
    GLint near_m_ = program_.uniform("near_m");
    GLint nearer_ = program_.uniform("nearer");
    GLint depth_from_w_ = program_.uniform("depth_from_w");
    GLint cut_ = program_.uniform("cut");
    GLint ink_ = program_.uniform("ink");
};

}  // namespace theatron::render
