// SPDX-License-Identifier: Apache-2.0
// A recording repeated in space to another picture size, for benchmarks: real
// sensor data in the size of a camera of which there is no recording.
#pragma once

#include <memory>

#include "capture/playback.h"
#include "video/color_codec.h"

namespace theatron::capture {

// Depth and colour come in `size`, colour always as pixels. The geometry of what
// is shown makes no sense any more.
class TiledRecording final : public Recording {
public:
    TiledRecording(std::unique_ptr<Recording> source, Size size);

    std::optional<Duration> offset() override { return source_->offset(); }
    void skip() override { source_->skip(); }
    void read(Frame& out) override;
    void rewind() override { source_->rewind(); }

private:
    std::unique_ptr<Recording> source_;
    Size size_;
    Frame frame_;
    std::unique_ptr<video::ColorDecoder> decoder_;
};

// The same change to a picture, and to a camera's model.
ColorImage tiled(const ColorImage& picture, Size size);
CameraModel tiled(CameraModel camera, Size size);

}  // namespace theatron::capture
