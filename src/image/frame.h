// SPDX-License-Identifier: Apache-2.0
// One depth image and one colour image of one camera at one moment.
//
// Frames are shared read-only between threads: `FramePtr` keeps one alive, and
// a FramePool takes its memory back when the last holder lets go.
#pragma once

#include <memory>

#include "base/bytes.h"
#include "base/ids.h"
#include "base/time.h"
#include "image/image.h"

namespace theatron {

// The named points in a frame's life, in session time. A point that has not
// been reached, or is not known, is the clock's origin.
struct FrameTimes {
    TimePoint captured;   // exposure; for a replayed or generated frame, when it was due
    TimePoint delivered;  // the driver or file handed it over
    TimePoint filtered;
    TimePoint encoded;
    TimePoint sent;
    TimePoint received;
    TimePoint decoded;
    TimePoint uploaded;
    TimePoint presented;
};

// Colour from the camera: pixels, or a JPEG picture that is not decoded yet.
// Exactly one of the two is filled, none if there is no colour.
struct ColorData {
    Size size;
    ColorImage pixels;
    Bytes jpeg;

    bool is_jpeg() const { return !jpeg.empty(); }
    bool empty() const { return jpeg.empty() && pixels.empty(); }
};

struct Frame {
    FrameNumber number = 0;
    FrameTimes times;
    DepthImage depth;
    ColorData color;
};

using FramePtr = std::shared_ptr<const Frame>;

}  // namespace theatron
