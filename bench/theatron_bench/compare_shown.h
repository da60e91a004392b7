// SPDX-License-Identifier: Apache-2.0
// The pictures that the expert sees: video as it arrived, clouds and points drawn.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare_judging.h"
#include "compare_paths.h"
#include "compare_sights.h"
#include "render/offscreen_context_native.h"

namespace theatron::bench {

// All pictures beside each other, black below those that are less high than the highest. There is
// at least one.
ColorImage beside_each_other(const std::vector<ColorImage>& pictures);

// The cameras as compare_sights.h wants them. `is_in_depth_raster`: colour arrives sampled to the
// pixels of depth.
std::vector<SightCamera> sight_cameras(const std::vector<const CompareCamera*>& cameras,
                                       const std::vector<ArrivedCamera>& arrived,
                                       bool is_in_depth_raster);

// Fills the pictures of a video call: its last camera's (of two, the first one's is that of the
// call with one), and in the close-up, beside each other, the part of each camera's that shows
// `point_room` close_up_width_m wide. Cameras that do not see it are left out there. `is_zoomed`:
// the whole picture is the close-up.
void show_video(CompareMethod& method, const std::vector<const CompareCamera*>& cameras,
                const std::vector<ArrivedCamera>& arrived, Vec3 point_room, bool is_zoomed);

// Draws with GL, if this machine has any. One thread makes and uses it.
class CompareDrawing {
public:
    CompareDrawing();
    // Empty without GL.
    std::string driver() const { return driver_; }
    // Throws Error if the driver has reported an error.
    void check() const;

    // Fills the drawing time of a video call; nothing without GL.
    void time_video(CompareMethod& method, const std::vector<ArrivedCamera>& arrived,
                    Size size) const;

    // Draws all of the last images in turn from the first place, since a renderer may have a
    // memory, then the newest from everywhere; without GL the method gets that as its reason.
    // `cameras` and `arrived` have one order. details: as of judge(). progress: 0 to 1.
    void show_clouds(CompareMethod& method, const CompareViews& exact,
                     const std::vector<const CompareCamera*>& cameras,
                     const std::vector<ArrivedCamera>& arrived, Image<float> details,
                     const std::string& renderer,
                     const std::function<void(double)>& progress) const;

private:
    std::unique_ptr<render::OffscreenContext> context_;
    std::string driver_, reason_;
};

// The same with points, drawn on the processor.
void show_points(CompareMethod& method, const CompareViews& exact,
                 const std::vector<const CompareCamera*>& cameras,
                 const std::vector<ArrivedCamera>& arrived, Image<float> details);

}  // namespace theatron::bench
