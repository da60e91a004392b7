// SPDX-License-Identifier: Apache-2.0
// Smooth closed surfaces around the labels of a label map. Pure functions.
#pragma once

#include <functional>
#include <vector>

#include "cases/label_map.h"
#include "medical/mesh.h"

namespace theatron::cases {

struct LabelCount {
    int value = 0;
    std::size_t samples = 0;
};
// The labels that occur, by value; 0 is none.
std::vector<LabelCount> labels_in(const LabelMap& map);

// The volume of one sample.
double sample_volume_mm3(const medical::VolumeGrid& grid);

// The surface around all samples of one label: closed, manifold, smoothed (steps of thick slices
// stay visible), as large as the samples together, of about `max_triangles`. Empty where the label
// does not occur or its surface has too many triangles. Also holds normals. `between_steps` is
// called often, and may throw to stop this.
medical::Mesh surface_of_label(
    const LabelMap& map, int value, std::size_t max_triangles,
    const std::function<void()>& between_steps = [] {});

}  // namespace theatron::cases
