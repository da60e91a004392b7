// SPDX-License-Identifier: Apache-2.0
// A small picture of a camera, for those who look before they join.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "base/time.h"
#include "image/frame.h"

namespace theatron::host {

// Safe from any thread.
class Thumbnail {
public:
    static constexpr int width = 240;  // pixels
    static constexpr Duration interval = std::chrono::seconds(2);

    // From the camera's thread, each frame: keeps one in two seconds that has colour, without
    // decoding it.
    void on_frame(const FramePtr& frame, TimePoint now);

    // The newest one as PNG; empty before there is one. Takes some milliseconds.
    std::string png();

private:
    std::mutex mutex_;
    ColorData color_;  // of the newest frame, small if it came as pixels
    TimePoint taken_;
    bool is_new_ = false;
    std::string png_;
};

// Every n-th pixel, so that the picture is at most `width` wide. Empty for an empty picture.
ColorImage small_picture(ColorView picture, int width);

}  // namespace theatron::host
