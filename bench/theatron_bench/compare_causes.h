// SPDX-License-Identifier: Apache-2.0
// Why surfaces are missing in a drawn picture: the first step on the way from the room to the
// picture after which a surface is gone.
#pragma once

#include <vector>

#include "compare.h"
#include "geometry/calibration.h"
#include "image/view.h"
#include "render/camera_view.h"

namespace theatron::bench {

// One camera's depth images of one moment, both of its calibrated size.
struct CauseCamera {
    Calibration calibration;
    DepthView measured;  // from the sensor
    DepthView arrived;   // behind filters and codecs
};

// A mask is not 0 at the pixels that count; all images have one size.
struct CauseInput {
    render::CameraView view;
    DepthView drawn_mm, exact_mm;
    View<const std::uint8_t> seen;   // pixels whose surface a camera sees
    View<const std::uint8_t> where;  // pixels that are judged
    // A surface is missing if nothing or something at least so far behind it is drawn, and a
    // camera has it if it measures something within this distance of it, before or behind.
    int jump_mm = 150;
};

// Shares of the judged surfaces that are not shown rightly. `input`: of the picture of `sights`;
// its drawn_mm is not used.
CompareCauses causes_of(const CauseInput& input, const std::vector<CauseCamera>& cameras,
                        const CompareSights& sights);

// Shares of the judged pixels. Pixels beside outlines do not count, as in render::Holes.
CompareCauses causes_of(const CauseInput& input, const std::vector<CauseCamera>& cameras);

}  // namespace theatron::bench
