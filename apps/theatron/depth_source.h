// SPDX-License-Identifier: Apache-2.0
// The depth images of some cameras: opened here, or those of a running session.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
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
    // one of these cameras has changed.
    virtual bool next(const Sink& sink) = 0;

protected:
    std::vector<Camera> cameras_;
};

// Screens, faces and cameras that move with a person stand nowhere and are left out. So are others
// than `only` (empty: all), which are cameras' names, and than those of `known`, if it is given.
struct WantedCameras {
    std::vector<std::string> only;
    std::optional<std::set<std::string>> known;  // those with a place in the file
};

// Throw Error, also if fewer than two cameras are left, if two have one name, or if one of `only`
// is not there. Those that are left out unasked are said on standard error.
std::unique_ptr<DepthSource> open_cameras(const std::vector<std::string>& specifications,
                                          const WantedCameras& choice,
                                          const capture::Progress& progress);
std::unique_ptr<DepthSource> join_for_depth(const net::Link& link, const WantedCameras& choice);

}  // namespace theatron::app
