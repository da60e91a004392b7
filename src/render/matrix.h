// SPDX-License-Identifier: Apache-2.0
// 4x4 matrices in GL's order: column by column.
#pragma once

#include <array>

#include "geometry/vec.h"
#include "render/camera_view.h"
#include "render/gl.h"

namespace theatron::render {

struct Mat4 {
    std::array<double, 16> m{};  // m[4 * column + row]
};

Mat4 operator*(const Mat4& a, const Mat4& b);
Mat4 matrix(const Pose& pose);

// Clip coordinates from the eye's frame. Their w is the distance along the
// view's axis in metres, which the shaders rely on.
Mat4 projection(const CameraView& view);

// These two set a uniform of the current program.
void set_matrix(GLint uniform, const Mat4& matrix);
// depth_from_w, with which shaders turn distance into window depth and back.
void set_depth_from_w(const CameraView& view, GLint uniform);

}  // namespace theatron::render
