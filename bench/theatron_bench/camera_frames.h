// SPDX-License-Identifier: Apache-2.0
// Frames of any camera, loaded into memory, for benchmarks.
#pragma once

#include <string>
#include <vector>

#include "capture/camera.h"
#include "capture/crop.h"
#include "image/image.h"

namespace theatron::bench {

struct CameraFrames {
    std::string camera;  // its specification
    std::string name;    // short, for display
    Calibration calibration;
    std::vector<DepthImage> depth;
    std::vector<ColorImage> color;  // decoded, of the same frames; empty if the camera has none
};

// The first `max_frames` frames of a camera, as it delivers them. If some frames have colour, those
// without it are left out. Throws Error if the camera cannot be opened, fails, or gives no depth.
CameraFrames load_camera_frames(const std::string& specification, int max_frames,
                                const capture::Progress& progress);

// The colour of each depth pixel (filter::ColorRegistration), in pictures of the size of the depth;
// black where there is no depth. Empty if the camera has no colour.
std::vector<ColorImage> registered_colors(const CameraFrames& frames);

// The same part of all images.
template <class T>
std::vector<Image<T>> parts_of(const std::vector<Image<T>>& images, const capture::Crop& crop) {
    std::vector<Image<T>> parts;
    for (const Image<T>& image : images) {
        parts.emplace_back(crop.size);
        copy_pixels(capture::part_of(image.view(), crop), parts.back().view());
    }
    return parts;
}

}  // namespace theatron::bench
