// SPDX-License-Identifier: Apache-2.0
// The recorded empty scene: for each pixel the nearest that was measured there
// while nobody was in the picture, and its file (docs/formats/background.md).
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::filter {

struct Background {
    DepthImage nearest;        // in the camera's unit; 0 = never measured
    double depth_unit_mm = 1;  // of the camera that it was recorded with
    int frames = 0;            // that it was made of

    bool operator==(const Background&) const = default;
};

// Adds a frame of the empty scene. The first one gives the size; a frame of
// another size is left out and false returned.
bool add_frame(Background& background, DepthView frame);

Bytes encode_background(const Background& background);

// Safe for untrusted input.
Result<Background> decode_background(ByteView bytes);

}  // namespace theatron::filter
