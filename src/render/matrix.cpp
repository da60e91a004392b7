// SPDX-License-Identifier: Apache-2.0
#include "render/matrix.h"

namespace theatron::render {

Mat4 operator*(const Mat4& a, const Mat4& b) {
    Mat4 product;
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t i = 0; i < 4; ++i)
                product.m[4 * column + row] += a.m[4 * i + row] * b.m[4 * column + i];
    return product;
}

Mat4 matrix(const Pose& pose) {
    const Mat3 r = matrix_from_quat(pose.rotation);
    const Vec3 t = pose.translation;
    return {{r.m[0][0], r.m[1][0], r.m[2][0], 0,  //
             r.m[0][1], r.m[1][1], r.m[2][1], 0,  //
             r.m[0][2], r.m[1][2], r.m[2][2], 0,  //
             t.x, t.y, t.z, 1}};
}

Mat4 projection(const CameraView& view) {
    const double width = view.right - view.left, height = view.bottom - view.top;
    const double n = view.near_m, f = view.far_m;
    // The eye's y points down, that of clip coordinates up.
    return {{2 / width, 0, 0, 0,    //
             0, -2 / height, 0, 0,  //
             -(view.right + view.left) / width, (view.bottom + view.top) / height,
             (f + n) / (f - n), 1,  //
             0, 0, -2 * f * n / (f - n), 0}};
}

void set_matrix(GLint uniform, const Mat4& matrix) {
    float values[16];
    for (std::size_t i = 0; i < 16; ++i)
        values[i] = float(matrix.m[i]);
    glUniformMatrix4fv(uniform, 1, GL_FALSE, values);
}

void set_depth_from_w(const CameraView& view, GLint uniform) {
    const double n = view.near_m, f = view.far_m;
    glUniform2f(uniform, float(f / (f - n)), float(-f * n / (f - n)));
}

}  // namespace theatron::render
