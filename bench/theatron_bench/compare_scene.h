// SPDX-License-Identifier: Apache-2.0
// The input of `theatron bench compare`: a second of the generated operation as its cameras deliver
// it, and what an expert at the table would see at its end.
#pragma once

#include "bench_view_scene.h"
#include "capture/camera.h"
#include "image/frame.h"

namespace theatron::bench {

struct CompareSceneOptions {
    int cameras = 2;         // 1 to 4
    int frames = 30;         // of each, at 30 a second
    Size picture{960, 540};  // of the expert
    bool quick = false;      // a coarse room and small pictures
};

struct CompareCamera {
    Calibration calibration;
    std::vector<DepthImage> depth;  // with the sensor's noise
    std::vector<ColorData> color;   // JPEG, as from a camera
    ColorImage last_exact;          // the last colour picture before noise and JPEG
};

// The width of the close-up at the wound.
inline constexpr double close_up_width_m = 0.6;

struct CompareScene {
    std::vector<CompareCamera> cameras;
    std::vector<ViewBenchPlace> places;  // at the moment of the last frames
    std::vector<std::string> place_names;
    ViewBenchPlace close_up;  // the wound from the first place
    Vec3 wound;
};

CompareScene make_compare_scene(const CompareSceneOptions& options,
                                const capture::Progress& progress);

}  // namespace theatron::bench
