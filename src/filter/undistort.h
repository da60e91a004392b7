// SPDX-License-Identifier: Apache-2.0
// Resamples pictures to those of a lens without distortion, for programs that support no
// other. Theatron itself leaves pictures unchanged and corrects the rays instead
// (geometry/ray_table.h), without loss.
#pragma once

#include <vector>

#include "geometry/camera_model.h"
#include "image/view.h"

namespace theatron::filter {

// The same camera without distortion.
CameraModel without_distortion(const CameraModel& camera);

// Maps pictures of one lens to those of another at the same position. apply() does not
// allocate.
class Undistortion {
public:
    Undistortion(const CameraModel& from, const CameraModel& to);

    // Nearest neighbour: distances are never interpolated. 0 where the source lens has no
    // picture.
    void apply(DepthView in, MutableDepthView out) const;
    // Bilinear. Black where the source lens has no picture.
    void apply(ColorView in, MutableColorView out) const;

private:
    // The source position of a pixel, in 1/256 pixel; x negative: none.
    struct Source {
        std::int32_t x, y;
    };
    Size from_, to_;
    std::vector<Source> sources_;
};

}  // namespace theatron::filter
