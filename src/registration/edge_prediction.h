// SPDX-License-Identifier: Apache-2.0
// What each pixel near a board should show, for one pose of it: an image that is computed as
// docs/synthetic_sensor.md describes the sensor, without its noise.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/ray_table.h"
#include "registration/background_depth.h"
#include "registration/rectified.h"

namespace theatron::registration {

// Columns left to right - 1, rows top to bottom - 1.
struct PixelWindow {
    int left, top, right, bottom;
};

// The part of the picture that shows a board and a rim of 3 cm around it.
PixelWindow window_of(const DepthLookup& lookup, const Pose& camera_from_face,
                      const LatticeTarget& target);

class EdgePrediction {
public:
    // `rays` must outlive the prediction and contain `window`.
    EdgePrediction(const LatticeTarget& target, Face face, const Image<Ray>& rays,
                   const PixelWindow& window);

    // `board_reach_m` behind the face, plus the tolerance of its depth, still counts as the board,
    // and `mixed_m` more as neither.
    void compute(const Pose& camera_from_face, const BackgroundDepth& background,
                 const EdgeParams& params, double board_reach_m, double mixed_m);

    // 1: the board, 0: what is behind, 0.5: neither; at a pixel of the window, two from its rim.
    double shown(int x, int y) const;

private:
    struct Hit {
        float depth_m = 0, light = 0;  // no depth: no ray
    };
    Hit hit(Ray ray) const;

    LatticeTarget target_;
    FacePattern pattern_;
    const Image<Ray>& rays_;
    PixelWindow window_;
    int width_;
    std::vector<Hit> hits_;

    // Of the last compute().
    Vec3 eye_;
    Quat face_from_camera_;
    double face_depth_m_ = 0, background_factor_ = 1;
    EdgeParams params_;
    BackgroundLight light_;
    std::array<double, 4> beyond_m_{};
    std::array<double, FacePattern::cell_count> through_m_{};
    double board_reach_m_ = 0, mixed_m_ = 0;
};

}  // namespace theatron::registration
