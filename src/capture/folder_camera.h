// SPDX-License-Identifier: Apache-2.0
// A folder of pictures as a camera (docs/formats/camera_folder.md).
#pragma once

#include "base/options.h"
#include "capture/camera.h"
#include "capture/playback.h"

namespace theatron::capture {

inline constexpr const char* folder_camera_help =
    "folder:DIR  pictures DIR/depth/*.png (16-bit grey) and DIR/color/*.jpg or *.png; "
    "fps=30, loop=0, start=0 (first frame), preload=1 (read all at start; usual below 1 GiB), "
    "invalid=65535 (a depth value that means no reading), tile=640x576 (repeated in space to this "
    "size, for benchmarks)";

// The pictures of a folder in order, without a clock.
struct FolderPictures {
    CameraInfo info;
    std::unique_ptr<Recording> recording;
    std::size_t frames = 0;  // depth pictures, damaged ones included
    std::size_t bytes = 0;   // of all pictures in memory, about
};

// Opens "folder:DIR" with the options `fps`, `invalid` and `tile`; those of playback must have been
// taken. Throws Error with one sentence if there is no such folder, none of its pictures can be
// read, or an option is wrong.
FolderPictures open_folder_pictures(Options& options);

std::unique_ptr<Camera> open_folder_camera(Options& options, const Progress& progress);

}  // namespace theatron::capture
