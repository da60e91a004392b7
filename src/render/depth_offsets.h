// SPDX-License-Identifier: Apache-2.0
// Depth cameras measure some millimetres too far or too near, the same in every frame. This hardly
// changes a shape, but from the side a camera's texture appears displaced against that of the next
// camera.
//
// The colours show the offset: a camera's points are moved along its rays until they have the
// texture that other cameras see there. It is the registration of Lucas and Kanade (1981) with one
// unknown for each camera; its start is found by a search, because texture repeats. Works on small
// copies of a few of the cameras' images, on the CPU, in some milliseconds now and then. Cameras
// whose calibration has an offset keep it, and the others follow them.
#pragma once

#include <map>
#include <vector>

#include "base/ids.h"
#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/image.h"

namespace theatron::render {

class DepthOffsets {
public:
    static constexpr double largest_m = 0.015;

    // Takes a camera's newest images; skips most of them. `color` may be empty.
    void add(CameraId camera, const Calibration& calibration, DepthView depth, ColorView color);
    void remove(CameraId camera) {
        cameras_.erase(camera);
        std::erase(waiting_, camera);
    }

    // Estimates the offset of one camera again if there are enough new images, or those of several
    // new cameras. True if it did. Call it for every picture, so that none waits for all cameras.
    bool update();

    // The offset by which a camera measures too far, in metres along its axis, at any distance; 0
    // without an estimate, and where the calibration has one. At most largest_m in either
    // direction. Changes slowly, except when a camera is first compared with others.
    double offset_m(CameraId camera) const;

private:
    // A place with texture on a flat part of a surface, in the depth camera's frame.
    struct Sample {
        Vec3 point, normal;
    };
    struct Camera {
        Calibration calibration;
        Image<Ray> rays;    // of the depth pixels that may be samples
        CameraModel color;  // of `brightness`
        DepthImage depth;
        Image<std::uint8_t> brightness;
        std::vector<Sample> samples;
        unsigned passed_over = 0;  // uploads to come
        int estimates = 0;         // that offset_m is of
        double offset_m = 0;
    };
    // The normal equation of an offset: error / weight is its correction, weight the certainty.
    // `cost` is the sum of squared differences of the textures over `samples` samples.
    struct Equation {
        double error = 0, weight = 0;
        double cost = 0, samples = 0;
    };
    bool has_unknown_offsets() const;
    static void find_samples(Camera& camera);
    static Equation compare(const Camera& a, const Camera& b, double offset_m, int size);
    Equation compare_with_others(CameraId camera, double offset_m, int size) const;
    double best_start_m(CameraId camera) const;
    void estimate(CameraId id, Camera& camera);

    std::map<CameraId, Camera> cameras_;
    std::size_t copies_ = 0;         // since the last estimates began
    std::vector<CameraId> waiting_;  // to be estimated
};

}  // namespace theatron::render
