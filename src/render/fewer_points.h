// SPDX-License-Identifier: Apache-2.0
// Depth images with fewer pixels: every n-th column and row, beginning with the first.
#pragma once

#include "geometry/camera_model.h"
#include "image/image.h"

namespace theatron::render {

// The camera whose pixels have the rays of these pixels.
CameraModel every_nth(CameraModel camera, int n);

// A pixel without depth gets the first depth of the n x n pixels to its lower right, so that holes
// and gaps at outlines do not become n times as wide. Nothing is averaged.
DepthImage every_nth(DepthView depth, int n);

}  // namespace theatron::render
