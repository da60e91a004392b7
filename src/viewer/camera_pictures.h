// SPDX-License-Identifier: Apache-2.0
// The images of the cameras as plain pictures: colour, depth in false colours, and both in one.
//
// The functions are pure. A class keeps what does not change from frame to frame.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/image.h"

namespace theatron::viewer {

// The distances along the camera's axis that get the first and the last colour, in metres.
struct DepthRange {
    double near_m = 0, far_m = 0;
    bool operator==(const DepthRange&) const = default;
};

// The range of most measured pixels, outwards to the next quarter of a metre; nullopt if nothing
// was measured.
std::optional<DepthRange> depth_range(const Calibration& calibration, DepthView depth);

// The colour of a share from 0 (near, bright) to 1 (far, dark); shares beyond are those of the
// ends. It gets darker with distance, so that it can be read without colour vision.
Rgb depth_color(double share);

// The largest size of this shape that is at most `width` wide, and not larger than the image.
Size fitted(Size image, int width);

// The image with `size` pixels, each of which is the mean of those that it replaces. Needs a size
// that is not larger than the image.
ColorImage reduced(ColorView color, Size size);

// False colours of the nearest depth pixels: distances are never mixed. Black where nothing was
// measured.
ColorImage depth_picture(const Calibration& calibration, DepthView depth, Size size,
                         DepthRange range);

// The same from the depth camera's view, half and half with the colour that the colour camera has
// for each measured point; black where nothing was measured. `rays` are those of the depth camera,
// `color` is of any size: a scaled picture of the calibrated colour camera.
ColorImage blended_picture(const Calibration& calibration, DepthView depth, const Image<Ray>& rays,
                           ColorView color, Size size, DepthRange range);

// Use from one thread.
class CameraPictures {
public:
    struct Pictures {  // null where the camera has no such image
        std::shared_ptr<const ColorImage> color, depth, blended;
        DepthRange range;
    };

    // The pictures of a frame, at most `width` wide. `number` is the frame's: with the same one and
    // width the pictures are those of the previous call. `color` may be empty: then the last one
    // stays. A range becomes only wider, so that colours keep their meaning.
    const Pictures& of(CameraId camera, std::uint64_t number, const Calibration& calibration,
                       DepthView depth, std::shared_ptr<const ColorImage> color, int width);

private:
    struct Kept {
        std::uint64_t number = 0;
        int width = 0;
        CameraModel lens;  // of the rays
        Image<Ray> rays;
        std::shared_ptr<const ColorImage> color;
        std::optional<DepthRange> range;
        Pictures pictures;
    };
    std::map<CameraId, Kept> kept_;
};

}  // namespace theatron::viewer
