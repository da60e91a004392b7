// SPDX-License-Identifier: Apache-2.0
// A camera as its frames know it: number, name, calibration, and what is computed once from that.
// Thread safe; no function needs Python's lock.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/pool.h"
#include "export/colored_points.h"
#include "geometry/calibration.h"
#include "image/frame.h"
#include "video/jpeg_native.h"

namespace theatron::python {

class CameraView {
public:
    CameraView(int number, std::string name, Calibration calibration)
        : number_(number), name_(std::move(name)), calibration_(std::move(calibration)) {}

    int number() const { return number_; }
    const std::string& name() const { return name_; }
    const Calibration& calibration() const { return calibration_; }

    // The picture in memory that is used again; null, and it counts, if it is damaged or has
    // another size than the calibration.
    std::shared_ptr<ColorImage> decode(ByteView jpeg) const;

    // One point for each measured pixel, row by row: in the depth camera's frame, or `in_room`.
    std::vector<ColoredPoint> points(const Frame& frame, bool in_room) const;

    // Colour pictures that decode() refused.
    std::uint64_t undecoded() const;

private:
    const int number_;
    const std::string name_;
    const Calibration calibration_;

    mutable Pool<ColorImage> pictures_;
    mutable std::mutex mutex_;  // guards all below
    mutable video::JpegDecompressor jpeg_;
    mutable std::optional<exporting::PointMaker> points_;
    mutable std::uint64_t undecoded_ = 0;
    mutable std::uint64_t undecoded_of_points_ = 0;  // decode() may count the same pictures
};

}  // namespace theatron::python
