// SPDX-License-Identifier: Apache-2.0
// The formats into which a recording can be converted. All functions throw Error.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "capture/recording_camera.h"

namespace theatron::exporting {

// The frames to export.
struct Selection {
    Duration from{0}, to = Duration::max();  // since the beginning of the recording; without `to`
    std::size_t every = 1;                   // 1: all of these; N: the first and then each Nth
};

// The cameras to export, each at its first frame.
struct ExportSource {
    std::vector<std::unique_ptr<capture::RecordedFrames>> cameras;
    std::vector<std::size_t> numbers;  // of each in the recording
    bool one_camera = false;           // only one was requested: it gets no folder of its own
    capture::Progress progress;
    Selection selection;
    // Number of undamaged colour pictures that could not be decoded; they are left out.
    std::uint64_t undecoded_color = 0;

    // Moves a camera to its next frame between `from` and `to`, and returns that one's time;
    // nullopt at the end.
    std::optional<Duration> next(std::size_t camera);
    // The same for the next frame that is selected; `seen` counts frames, from 0.
    std::optional<Duration> next_selected(std::size_t camera, std::size_t& seen);
};

// Each returns the number of written files or frames.
//
// DIR/00000.ply and so on, for several cameras DIR/camera-0/00000.ply, in the frame of each depth
// camera; `merged`: one file for each moment with the points of all cameras, in the room. Cameras
// that see a person, who moves, are not merged. In both folders, times.csv has a line for each
// frame: its number, its time in seconds since the beginning of the recording, and the time of day.
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
