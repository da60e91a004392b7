// SPDX-License-Identifier: Apache-2.0
// Depth images with fewer pixels: of every n-th column and row, from the first.
#pragma once

#include "geometry/camera_model.h"
#include "image/image.h"

namespace theatron::render {

// The camera that sees through those pixels' rays.
CameraModel every_nth(CameraModel camera, int n);

// Where such a pixel has no depth, it gets the first one of the n x n pixels to its lower right, so
// that holes and gaps at outlines do not become n times as wide. Nothing is averaged.
DepthImage every_nth(DepthView depth, int n);

}  // namespace theatron::render
