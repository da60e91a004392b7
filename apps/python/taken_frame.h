// SPDX-License-Identifier: Apache-2.0
// A frame that a reader has given, with its place in time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/utc.h"
#include "camera_view.h"
#include "image/frame.h"

namespace theatron::python {

struct TakenFrame {
    std::shared_ptr<const CameraView> camera;
    std::shared_ptr<const Frame> frame;
    bool is_own = false;         // nobody else has `frame`, so that its pixels may be changed
    double seconds = 0;          // since the first frame of the recording or of the camera
    std::int64_t moment_us = 0;  // session time; equal for frames that belong together
    UtcTime utc{};               // the epoch: not known
};

}  // namespace theatron::python
