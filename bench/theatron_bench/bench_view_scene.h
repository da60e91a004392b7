// SPDX-License-Identifier: Apache-2.0
// The input of `theatron bench view`: cameras in the generated operating room, as received by a
// viewer, and exact pictures from viewpoints between them.
#pragma once

#include <vector>

#include "capture/camera.h"
#include "filter/chain_settings.h"
#include "geometry/calibration.h"
#include "image/image.h"
#include "render/camera_view.h"
#include "synthetic/operating_room.h"

namespace theatron::bench {

// One camera: calibration, exact images, and images after sensor noise, filters and codecs.
struct ViewBenchCamera {
    Calibration calibration;
    Image<float> exact_depth_m;
    ColorImage exact_color;
    // Frames of one moment, which differ by noise only.
    static constexpr int frames = 5;
    DepthImage depth[frames];
    ColorImage color[frames];
    // The last frame's picture from a colour camera with more pixels, and its model.
    ColorImage fine_color;
    CameraModel fine_model;
};

// A viewpoint with its ground truth.
struct ViewBenchPlace {
    render::CameraView view;
    DepthImage exact_mm;
    ColorImage exact_color;
    // Masks as render::MaskView. seen: pixels whose surface a camera sees at 10 degrees or more.
    // overlap: measured by two cameras. person: of a person, and seen. patterned: finely
    // patterned, and measured. instrument: of polished metal, whether a camera sees it or not.
    Image<std::uint8_t> seen, overlap, person, patterned, instrument;
};

// From where, and to which point of the room, a picture is taken.
struct ViewBenchEye {
    Vec3 from, to;
    double fov_degrees = 70;  // horizontal
};

struct ViewBenchOptions {
    int cameras = 4;               // 1 to 12
    Size picture{640, 360};        // of the exact pictures
    Size color{1280, 720};         // of the cameras' pictures
    Size fine_color{1920, 1080};   // of the second colour picture, for fine patterns
    double exposure_stops = 0.12;  // standard deviation between cameras
    double detail = 1;             // of the generated room
    double seconds = 3;            // time in the room's loop
    filter::ChainSettings filter;  // of the cameras' depth; without background
};

struct ViewBenchScene {
    std::vector<ViewBenchCamera> cameras;
    std::vector<ViewBenchPlace> places;  // 12, between and beside the cameras
    std::vector<ViewBenchPlace> close;   // near finely patterned surfaces
};

ViewBenchScene make_view_bench_scene(const ViewBenchOptions& options,
                                     const capture::Progress& progress);

// The exact picture from one viewpoint. It uses the cameras' calibration, exact depth and the
// last depth image.
ViewBenchPlace make_view_bench_place(const synthetic::OperatingRoom& room,
                                     const synthetic::RoomMoment& moment,
                                     const std::vector<ViewBenchCamera>& cameras,
                                     const ViewBenchEye& eye, Size picture);

// The images of one camera's frame as received by a viewer.
struct ViewBenchImages {
    Calibration calibration;
    DepthImage depth;
    ColorImage color;
};

// Colour in the raster of the depth image: the picture interpolated at each depth pixel's place.
ViewBenchImages depth_sized_color(const Calibration& calibration, DepthView depth, ColorView color);

// Colour as in drivers and programs that send points: each depth pixel gets the colour pixel that
// it projects to (filter::ColorRegistration). Depth pixels without colour are dropped.
ViewBenchImages registered_color(const Calibration& calibration, DepthView depth, ColorView color);

}  // namespace theatron::bench
