// SPDX-License-Identifier: Apache-2.0
// Converts exact ground truth to the compressed images of one camera's frame.
#pragma once

#include <memory>

#include "base/bytes.h"
#include "synthetic/loop_options.h"
#include "video/color_codec.h"

namespace theatron::synthetic {

struct EncodedFrame {
    Bytes depth;  // codec/rvl.h
    Bytes color;  // JPEG; empty without colour
};

// Exact depth rounded to millimetres inside the hexagon, 0 elsewhere.
void exact_depth_mm(const Image<float>& depth_m, DepthImage& out);

// One thread at a time. Frames may be made in any order.
class FrameMaker {
public:
    explicit FrameMaker(const LoopOptions& options);
    ~FrameMaker();

    EncodedFrame encode(const GroundTruth& truth, std::uint32_t frame);

private:
    struct Sensor;
    std::unique_ptr<Sensor> sensor_;  // null: exact images
    std::unique_ptr<video::ColorEncoder> jpeg_;
    DepthImage depth_;
    ColorData color_;
    Bytes scratch_;
};

}  // namespace theatron::synthetic
