// SPDX-License-Identifier: Apache-2.0
// Any bytes as a depth image: the detector stays inside its buffers and ends, and its result is
// finite and in front of the camera.
#include <cmath>
#include <cstdlib>
#include <utility>

#include "registration/lattice_detector.h"

using namespace theatron;
using namespace theatron::registration;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const CameraModel camera = pinhole({64, 48}, 75);
    static LatticeDetector detector(camera, 1, large_target());
    DepthImage depth(camera.size);
    if (size < 4)
        return 0;
    // Few bytes make a whole picture: each adds to a slope or starts a surface.
    int value = 1500, slope = 0;
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        const int byte = data[i % size];
        if (byte > 250)
            value = byte == 255 ? 0 : 1000 * (byte - 250);
        else if (byte > 240)
            slope = byte - 245;
        value += slope + (byte & 1);
        depth.pixels[i] = std::uint16_t(value);
    }
    const auto found = detector.detect(std::as_const(depth).view());
    if (!found)
        return 0;
    const Vec3 at = found->camera_from_board.translation;
    if (!std::isfinite(at.x + at.y + at.z) || at.z <= 0 || !found->fit.covariance.allFinite())
        std::abort();
    return 0;
}
