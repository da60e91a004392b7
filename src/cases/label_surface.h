// SPDX-License-Identifier: Apache-2.0
// Smooth closed surfaces around the labels of a label map. Pure functions.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cases/label_map.h"
#include "medical/mesh.h"

namespace theatron::cases {

struct LabelCount {
    int value = 0;
    std::size_t samples = 0;
    // The block of samples that holds them, ends excluded; columns, rows, slices.
    int first[3] = {1 << 30, 1 << 30, 1 << 30};
    int end[3] = {0, 0, 0};
};
// The labels that occur, by value; 0 is none.
std::vector<LabelCount> labels_in(const LabelMap& map);

// The volume of one sample.
double sample_volume_mm3(const medical::VolumeGrid& grid);

// The most that the surfaces of one import take together: samples of the labels' blocks, and
// triangles before they are simplified. Each takes some nanoseconds, or microseconds; a small
// packed file can hold many labels that are everywhere, or one whose surface is.
inline constexpr std::uint64_t max_surface_samples = std::uint64_t(1) << 32;
inline constexpr std::size_t max_surface_triangles = std::size_t(1) << 25;

// How much of it is left.
struct SurfaceBudget {
    std::uint64_t samples = max_surface_samples;
    std::size_t triangles = max_surface_triangles;
};

// The surface around all samples of one label: closed, manifold, smoothed (steps of thick slices
// stay visible), as large as the samples together, of about `max_triangles`. Empty where its
// surface has too many triangles, or more than the budget has left, from which it is taken. Also
// holds normals. `between_steps` is called often, and may throw to stop this.
medical::Mesh surface_of_label(
    const LabelMap& map, const LabelCount& label, std::size_t max_triangles, SurfaceBudget& budget,
    const std::function<void()>& between_steps = [] {});

}  // namespace theatron::cases
