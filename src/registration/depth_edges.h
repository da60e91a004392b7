// SPDX-License-Identifier: Apache-2.0
// Occluding edges in the depth images of a still camera: where a near surface ends before a far
// one. Surfaces do not show a motion along themselves; their ends do.
//
// A window of some pixels across an edge holds near and far pixels. Their numbers, mixed pixels
// counted in part, give the edge's place to a fraction of a pixel, with the same errors in each
// image.
#pragma once

#include <cstdint>
#include <vector>

#include "registration/surface_grid.h"

namespace theatron::registration {

struct DepthEdge {
    int x = 0, y = 0;           // the pixel in the middle of the window
    bool is_in_row = true;      // the window lies along the row, otherwise along the column
    bool is_near_first = true;  // the near surface has the lower coordinates
    float near_units = 0, far_units = 0;
    float position = 0;  // from the middle pixel to the edge along the window, pixels
    // A point of the edge, and the normal of the plane that contains the edge's line and the
    // camera; camera frame, metres.
    Vec3 at, normal;
};

// Sums of depth images, from which the edges are taken that stood still.
class EdgeReference {
public:
    explicit EdgeReference(Size size);

    // `depth` must have the size given to the constructor.
    void add(DepthView depth);

    // Straight edges between surfaces that were measured in most of the images and deviated by less
    // than `spread_m`.
    std::vector<DepthEdge> edges(const SurfaceCamera& camera, double spread_m) const;

private:
    struct Scan;

    Size size_;
    int images_ = 0;
    std::vector<std::uint32_t> sums_;
    std::vector<double> squares_;
    std::vector<std::uint16_t> counts_;
};

// DepthEdge::position of each edge in another image of the same camera; NaN where something else
// than the two surfaces is in its window, or most of it was not measured.
std::vector<float> edge_positions(const std::vector<DepthEdge>& edges, DepthView depth);

// The point of the edge where it is at `position`, at the depth of the near surface. False where
// the lens has no ray.
bool edge_point(const DepthEdge& edge, float position, const SurfaceCamera& camera, Vec3& point);

}  // namespace theatron::registration
