// SPDX-License-Identifier: Apache-2.0
// The input of `theatron bench compare`: a second of the generated operation as its cameras deliver
// it, and what an expert at the table would see at its end.
#pragma once

#include "bench_view_scene.h"
#include "capture/camera.h"
#include "image/frame.h"

namespace theatron::bench {

struct CompareSceneOptions {
    int cameras = 2;         // 1 to 4, without the near one
    int frames = 30;         // of each, at 30 a second
    Size picture{960, 540};  // of the expert
    bool quick = false;      // a coarse room and small pictures
};

struct CompareCamera {
    Calibration calibration;
    std::vector<DepthImage> depth;  // with the sensor's noise; none of a video camera
    std::vector<ColorData> color;   // JPEG, as from a camera
    ColorImage last_exact;          // the last colour picture before noise and JPEG
    Image<float> last_exact_m;      // the distances at its pixels along the colour camera's axis
};

// The width of the close-up at the wound, and the diameter of the region that is close to it.
inline constexpr double close_up_width_m = 0.6, near_wound_m = 0.2;

// The expert's exact pictures at the moment of the last frames, with masks of what some cameras
// see.
struct CompareViews {
    std::vector<ViewBenchPlace> places;
    ViewBenchPlace close_up;         // the wound from the first place
    Image<std::uint8_t> near_wound;  // not 0 in its pixels close to the wound
};

struct CompareScene {
    std::vector<CompareCamera> cameras;  // the near one last: it hangs over the table's foot
    CompareViews without_near, with_near;
    std::vector<std::string> place_names;
    // Video cameras at the first camera's place: one with its lens and more pixels, and one whose
    // lens shows the wound as wide as the close-up.
    CompareCamera full_hd, zoomed;
    Vec3 wound;

    const CompareCamera& near_camera() const { return cameras.back(); }
    // All without the near one.
    std::vector<const CompareCamera*> usual_cameras() const;
};

CompareScene make_compare_scene(const CompareSceneOptions& options,
                                const capture::Progress& progress);

}  // namespace theatron::bench
