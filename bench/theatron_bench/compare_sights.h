// SPDX-License-Identifier: Apache-2.0
// Tells for each surface that the expert should see whether a picture shows it, shows something
// else in its place, or does not show it. Drawn pictures and cameras' pictures have the same
// measure.
#pragma once

#include <vector>

#include "compare.h"
#include "geometry/calibration.h"
#include "render/camera_view.h"

namespace theatron::bench {

// A surface counts as shown where the drawn one is at most so far before or behind it.
inline constexpr int shown_within_mm = 20;
// Pixels of a camera of at most this size count as fine.
inline constexpr double fine_detail_mm = 1;

// A picture of `exact_mm`'s size for each; 0 mm: no surface.
struct ExactSurfaces {
    render::CameraView view;
    DepthView exact_mm;
};

// A camera with the exact distances along its axis at the pixels of its lens, 0 m where there is
// none. They may be coarser than the pictures that it sends.
struct SightCamera {
    CameraModel lens;  // of the pictures that arrive
    Pose room_from_lens;
    View<const float> exact_m;
    double coarsest_mm_at_1m = 0;  // of a pixel of a coarser raster to which colour is sampled
    double grid_mm = 0;            // between points to which surfaces are rounded
};

// For each surface the size of a pixel of the finest camera that sees it, in mm across its line of
// sight; 0 where none sees it.
Image<float> finest_details(const ExactSurfaces& exact, const std::vector<SightCamera>& cameras);

// Pictures of the cameras themselves: what one sees is shown, nothing is replaced.
CompareSights sights_of_video(const ExactSurfaces& exact, Image<float> details);

// A picture that was drawn for the same view.
CompareSights sights_of_drawn(const ExactSurfaces& exact, DepthView drawn_mm, Image<float> details);

// Two pictures side by side: a surface is shown if either shows it, and replaced if one shows
// something else there and the other does not show it. Equal sizes.
CompareSights sights_of_both(const CompareSights& one, const CompareSights& other);

// Not 0 at the pixels whose line of sight passes `point_room` within `diameter_m / 2`.
Image<std::uint8_t> region_around(const render::CameraView& view, Size picture, Vec3 point_room,
                                  double diameter_m);

// Over the surfaces in the region.
CompareShares shares_of(const CompareSights& sights, View<const std::uint8_t> region);

// The picture with stripes: magenta over surfaces that are replaced, cyan in the other direction
// over those that are not shown, and a white line around the region. Equal sizes.
ColorImage marked(const ColorImage& picture, const CompareSights& sights,
                  View<const std::uint8_t> region);

}  // namespace theatron::bench
