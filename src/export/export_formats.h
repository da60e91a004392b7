// SPDX-License-Identifier: Apache-2.0
// The formats into which a recording can be converted. All functions throw Error.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "capture/recording_camera.h"

namespace theatron::exporting {

// The cameras to export, each at its first frame.
struct ExportSource {
    std::vector<std::unique_ptr<capture::RecordedFrames>> cameras;
    std::vector<std::size_t> numbers;  // of each in the recording
    bool one_camera = false;           // only one was requested: it gets no folder of its own
    capture::Progress progress;
    // Number of undamaged colour pictures that could not be decoded; they are left out.
    std::uint64_t undecoded_color = 0;
};

// Each returns the number of written files or frames.
//
// DIR/00000.ply and so on, for several cameras DIR/camera-0/00000.ply, in the frame of each depth
// camera; `merged`: one file for each moment with the points of all cameras, in the room. Cameras
// that see a person, who moves, are not merged.
std::size_t export_ply(ExportSource& source, const std::filesystem::path& folder, bool merged);
// The layout of folder:DIR, for several cameras in DIR/camera-0 and so on.
enum class Pictures {
    recorded,
    undistorted,  // pictures and calibration of lenses without distortion
    registered,   // colour in the raster of depth; black where the colour camera sees nothing of it
};
std::size_t export_png(ExportSource& source, const std::filesystem::path& folder,
                       Pictures pictures);
// An Azure Kinect's recording, of one camera.
std::size_t export_k4a(ExportSource& source, const std::filesystem::path& file);

}  // namespace theatron::exporting
