// SPDX-License-Identifier: Apache-2.0
// The depth images of some cameras: opened here, or those of a running session.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/time.h"
#include "capture/camera.h"
#include "net/link.h"

namespace theatron::app {

class DepthSource {
public:
    struct Camera {
        std::string name;
        Calibration calibration;
        std::string filter;  // that its depth has gone through; empty: none
    };
    // A view is valid during the call. Times are of one clock.
    using Sink = std::function<void(std::size_t camera, DepthView depth, TimePoint captured)>;

    virtual ~DepthSource() = default;
    const std::vector<Camera>& cameras() const { return cameras_; }

    // Waits a short time, and passes on the depth images that have come, each in its camera's size.
    // False once no more will come. Throws Error if a camera failed, or if the session was lost or
    // has changed its cameras.
    virtual bool next(const Sink& sink) = 0;

protected:
    std::vector<Camera> cameras_;
};

// Throw Error, also if there are fewer than two cameras or if two have one name.
std::unique_ptr<DepthSource> open_cameras(const std::vector<std::string>& specifications,
                                          const capture::Progress& progress);
std::unique_ptr<DepthSource> join_for_depth(const net::Link& link);

}  // namespace theatron::app
