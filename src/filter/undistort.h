// SPDX-License-Identifier: Apache-2.0
// Resamples pictures to those of a lens without distortion, for programs that
// know no other. Theatron itself keeps pictures as they are and corrects the rays
// instead (geometry/ray_table.h), which loses nothing.
#pragma once

#include <vector>

#include "geometry/camera_model.h"
#include "image/view.h"

namespace theatron::filter {

// The same camera with all distortion zero.
CameraModel without_distortion(const CameraModel& camera);

// From the pictures of one lens to those of another at the same place. Made once;
// applying allocates nothing.
class Undistortion {
public:
    Undistortion(const CameraModel& from, const CameraModel& to);

    // Each pixel is the nearest one: distances are never mixed. 0 where the lens
    // saw nothing.
    void apply(DepthView in, MutableDepthView out) const;
    // Each pixel is mixed of four. Black where the lens saw nothing.
    void apply(ColorView in, MutableColorView out) const;

private:
    // Where a pixel comes from, in 1/256 pixel; x negative: from nowhere.
    struct Source {
        std::int32_t x, y;
    };
    Size from_, to_;
    std::vector<Source> sources_;
};

}  // namespace theatron::filter
