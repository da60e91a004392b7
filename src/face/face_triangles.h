// SPDX-License-Identifier: Apache-2.0
// A face with fewer of its triangles. Pure.
#pragma once

#include "face/enrolled_face.h"

namespace theatron::face {

inline constexpr std::uint32_t gone_vertex = 0xffffffff;

// The face with these triangles in place of its own, in the same order, and with the vertices that
// they have. One whose first corner is gone_vertex is left out.
EnrolledFace with_triangles(const EnrolledFace& face,
                            const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace theatron::face
