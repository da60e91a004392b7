// SPDX-License-Identifier: Apache-2.0
#include "cases/glb_place.h"

#include <cmath>

namespace theatron::cases::glb {

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t i = 0; i < 4; ++i)
                out[4 * column + row] += a[4 * i + row] * b[4 * column + i];
    return out;
}

Vec3 placed(const Matrix& m, Vec3 p) {
    return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
            m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
            m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

bool is_mirrored(const Matrix& m) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
               m[8] * (m[1] * m[6] - m[2] * m[5]) <
           0;
}

namespace {

// `count` numbers of a node's property; false where they are there and are none.
template <std::size_t count>
bool read_numbers(const Json& node, const char* name, std::array<double, count>& out) {
    const auto list = node.find(name);
    if (list == node.end())
        return true;
    if (!list->is_array() || list->size() != count)
        return false;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(*list)[i].is_number())
            return false;
        out[i] = (*list)[i].template get<double>();
    }
    return true;
}

}  // namespace

const char* read_place(const Json& node, Matrix& out) {
    out = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    constexpr double rounding = 1e-6;
    if (node.contains("matrix"))
        return read_numbers(node, "matrix", out) && std::abs(out[3]) <= rounding &&
                       std::abs(out[7]) <= rounding && std::abs(out[11]) <= rounding &&
                       std::abs(out[15] - 1) <= rounding
                   ? nullptr
                   : "matrix";
    std::array<double, 3> t{}, s{1, 1, 1};
    std::array<double, 4> q{0, 0, 0, 1};
    if (!read_numbers(node, "translation", t))
        return "translation";
    if (!read_numbers(node, "scale", s))
        return "scale";
    // Its length is 1, as far as its digits allow.
    const bool are_numbers = read_numbers(node, "rotation", q);
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!are_numbers || !(size > rounding) || !std::isfinite(size))
        return "rotation";
    for (double& part : q)
        part /= size;
    const auto [x, y, z, w] = q;
    out = {(1 - 2 * (y * y + z * z)) * s[0],
           2 * (x * y + z * w) * s[0],
           2 * (x * z - y * w) * s[0],
           0,
           2 * (x * y - z * w) * s[1],
           (1 - 2 * (x * x + z * z)) * s[1],
           2 * (y * z + x * w) * s[1],
           0,
           2 * (x * z + y * w) * s[2],
           2 * (y * z - x * w) * s[2],
           (1 - 2 * (x * x + y * y)) * s[2],
           0,
           t[0],
           t[1],
           t[2],
           1};
    return nullptr;
}

}  // namespace theatron::cases::glb
