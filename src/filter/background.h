// SPDX-License-Identifier: Apache-2.0
// The recorded empty scene: for each pixel the nearest depth measured while no person was
// in the picture. docs/formats/background.md specifies its file.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::filter {

struct Background {
    DepthImage nearest;        // in the camera's unit; 0 = never measured
    double depth_unit_mm = 1;  // of the camera that recorded it
    int frames = 0;            // number of recorded frames

    bool operator==(const Background&) const = default;
};

// Adds a frame of the empty scene. The first frame sets the size; a frame of another size
// is ignored, and false is returned.
bool add_frame(Background& background, DepthView frame);

Bytes encode_background(const Background& background);

// Safe for untrusted input.
Result<Background> decode_background(ByteView bytes);

}  // namespace theatron::filter
