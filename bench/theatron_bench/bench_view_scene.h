// SPDX-License-Identifier: Apache-2.0
// What `theatron bench view` draws and compares with: cameras in the generated operating
// room, as they arrive at a viewer, and exact pictures from places where no camera stands.
#pragma once

#include <vector>

#include "capture/camera.h"
#include "filter/chain_settings.h"
#include "geometry/calibration.h"
#include "image/image.h"
#include "render/camera_view.h"

namespace theatron::bench {

// One camera's calibration and what a viewer has of it after sensor noise, filters and codecs.
struct ViewBenchCamera {
    Calibration calibration;
    Image<float> exact_depth_m;
    ColorImage exact_color;
    // Frames of one moment: all that differs is noise.
    static constexpr int frames = 5;
    DepthImage depth[frames];
    ColorImage color[frames];
    // The last frame's picture from a colour camera of more pixels, and that camera.
    ColorImage fine_color;
    CameraModel fine_model;
};

// A place to look from, and the truth.
struct ViewBenchPlace {
    render::CameraView view;
    DepthImage exact_mm;
    ColorImage exact_color;
    // Pixels whose surface one camera sees at least, at 10 degrees or more; that two have measured;
    // that are a person's and seen; that are finely patterned and measured. As render::MaskView.
    Image<std::uint8_t> seen, overlap, person, patterned;
};

struct ViewBenchOptions {
    int cameras = 4;               // 1 to 12
    Size picture{640, 360};        // of the exact pictures
    Size color{1280, 720};         // of the cameras' pictures
    Size fine_color{1920, 1080};   // of a second picture, for what has fine patterns
    double exposure_stops = 0.12;  // standard deviation between cameras
    double detail = 1;             // of the generated room
    double seconds = 3;            // the moment
    filter::ChainSettings filter;  // of the hosts' depth; without background
};

struct ViewBenchScene {
    std::vector<ViewBenchCamera> cameras;
    std::vector<ViewBenchPlace> places;  // 12, between and beside the cameras
    std::vector<ViewBenchPlace> close;   // near what has fine patterns
};

ViewBenchScene make_view_bench_scene(const ViewBenchOptions& options,
                                     const capture::Progress& progress);

// What a viewer gets of one camera's frame.
struct ViewBenchImages {
    Calibration calibration;
    DepthImage depth;
    ColorImage color;
};

// Colour in the depth image's pixels: the picture interpolated at each depth pixel's place.
ViewBenchImages depth_sized_color(const Calibration& calibration, DepthView depth, ColorView color);

// As drivers and programs that send points do it: each depth pixel gets the one pixel of the colour
// picture that it falls on (filter::ColorRegistration). Those that get none lose their depth.
ViewBenchImages registered_color(const Calibration& calibration, DepthView depth, ColorView color);

}  // namespace theatron::bench
