// SPDX-License-Identifier: Apache-2.0
// Predicts the pixels near a board for one pose of it: an image computed as in
// docs/synthetic_sensor.md, without the sensor's noise.
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

// The part of the depth image that shows a board and a rim of 3 cm around it.
PixelWindow window_of(const DepthLookup& lookup, const Pose& camera_from_face,
                      const LatticeTarget& target);

class EdgePrediction {
public:
    // `rays` must outlive the prediction and contain `window`.
    EdgePrediction(const LatticeTarget& target, Face face, const Image<Ray>& rays,
                   const PixelWindow& window);

    // Depth up to `board_reach_m` plus the tolerance of the face's depth behind the face counts as
    // the board, depth up to `mixed_m` farther as neither board nor background. Metres.
    void compute(const Pose& camera_from_face, const BackgroundDepth& background,
                 const EdgeParams& params, double board_reach_m, double mixed_m);

    // 1: board, 0: background, 0.5: neither. The pixel must be at least two inside the window.
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

    // Inputs of the last compute().
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
