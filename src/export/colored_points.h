// SPDX-License-Identifier: Apache-2.0
// Frames of a camera as coloured points: what `theatron export --ply` writes.
#pragma once

#include <optional>
#include <vector>

#include "filter/color_registration.h"
#include "geometry/calibration.h"
#include "geometry/ply.h"
#include "geometry/ray_table.h"
#include "image/frame.h"
#include "video/jpeg_native.h"

namespace theatron::exporting {

// The colour of each depth pixel. One thread at a time.
class ColorOfDepth {
public:
    // Counts pictures that it cannot decode in `undecoded`, which must outlive this object.
    // Precondition: the calibration has depth and colour.
    ColorOfDepth(const Calibration& calibration, std::uint64_t& undecoded);

    // False if the frame has no colour, or none that can be decoded. The result is valid until the
    // next call. Precondition: the frame's depth has the calibration's size.
    bool apply(const Frame& frame);
    ColorView color() const { return out_.view(); }  // black where the colour camera sees nothing
    Rgb color_at(std::size_t pixel) const { return out_.pixels[pixel]; }
    bool seen(std::size_t pixel) const { return seen_.pixels[pixel] != 0; }

private:
    std::uint64_t& undecoded_;
    Size size_;
    filter::ColorRegistration registration_;
    video::JpegDecompressor jpeg_;
    ColorImage decoded_, out_;
    Image<std::uint8_t> seen_;
};

// One thread at a time.
class PointMaker {
public:
    // As ColorOfDepth. Precondition: the calibration has depth.
    PointMaker(const Calibration& calibration, std::uint64_t& undecoded);

    // Appends a point in the depth camera's frame, in metres, for each measured pixel, row by row.
    // Points that the colour camera does not see have unseen_color.
    void append(const Frame& frame, std::vector<ColoredPoint>& out);

    const Calibration& calibration() const { return calibration_; }

private:
    Calibration calibration_;
    Image<Ray> rays_;
    std::optional<ColorOfDepth> colors_;
};

}  // namespace theatron::exporting
