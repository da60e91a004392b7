// SPDX-License-Identifier: Apache-2.0
// The 68 landmarks of the largest face in a photo, by dlib: its finder of faces (histograms of
// oriented gradients) and its model of landmarks (Kazemi and Sullivan, CVPR 2014).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace theatron::landmarks {

struct Photo {
    int width = 0, height = 0;
    std::vector<unsigned char> colors;  // red, green, blue of each pixel, the upper row first
};

enum class Outcome { found, no_face, no_model };

struct Found {
    int faces = 0;                              // in the photo
    std::vector<std::pair<long, long>> points;  // x and y of each landmark of the largest one
};

// `file` is a shape_predictor of dlib. May throw what dlib throws.
Outcome find(const Photo& photo, const std::string& file, Found& found);

}  // namespace theatron::landmarks
