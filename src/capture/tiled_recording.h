// SPDX-License-Identifier: Apache-2.0
// Tiles a recording to another picture size, for benchmarks: real sensor data in the size of a
// camera without recordings.
#pragma once

#include <memory>

#include "capture/playback.h"
#include "video/color_codec.h"

namespace theatron::capture {

// Depth and colour have size `size`; colour is always pixels. The geometry of the scene is not
// meaningful.
class TiledRecording final : public Recording {
public:
    TiledRecording(std::unique_ptr<Recording> source, Size size);

    std::optional<Duration> offset() override { return source_->offset(); }
    void skip() override { source_->skip(); }
    bool read(Frame& out) override;
    void rewind() override { source_->rewind(); }
    std::uint64_t lost_pictures() const override { return source_->lost_pictures(); }

private:
    std::unique_ptr<Recording> source_;
    Size size_;
    Frame frame_;
    std::unique_ptr<video::ColorDecoder> decoder_;
};

// Tiles a single picture, and adapts a camera's model.
ColorImage tiled(const ColorImage& picture, Size size);
CameraModel tiled(CameraModel camera, Size size);

}  // namespace theatron::capture
