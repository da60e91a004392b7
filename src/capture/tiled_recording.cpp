// SPDX-License-Identifier: Apache-2.0
#include "capture/tiled_recording.h"

#include "base/error.h"

namespace theatron::capture {
namespace {

template <class T>
void tile(const Image<T>& source, Image<T>& out) {
    for (int y = 0; y < out.size.height; ++y) {
        const T* from = source.view().row(y % source.size.height);
        T* to = out.view().row(y);
        for (int x = 0; x < out.size.width; ++x)
            to[x] = from[x % source.size.width];
    }
}

}  // namespace

TiledRecording::TiledRecording(std::unique_ptr<Recording> source, Size size)
    : source_(std::move(source)),
      size_(size),
      decoder_(video::make_color_decoder(video::ColorCodecId::jpeg)) {}

bool TiledRecording::read(Frame& out) {
    if (!source_->read(frame_))
        return false;
    out.depth.resize(size_);
    tile(frame_.depth, out.depth);

    out.color.jpeg.clear();
    if (frame_.color.is_jpeg()) {
        auto decoded =
            decoder_->submit(frame_.color.jpeg, 0) == Status::ok ? decoder_->poll() : std::nullopt;
        if (!decoded)
            throw Error("A colour picture of the recording is damaged.");
        std::swap(frame_.color.pixels, decoded->image);
        decoder_->recycle(std::move(decoded->image));
    }
    if (frame_.color.pixels.empty()) {
        out.color.pixels = {};
        return true;
    }
    out.color.size = size_;
    out.color.pixels.resize(size_);
    tile(frame_.color.pixels, out.color.pixels);
    return true;
}

ColorImage tiled(const ColorImage& picture, Size size) {
    ColorImage out(size);
    tile(picture, out);
    return out;
}

CameraModel tiled(CameraModel camera, Size size) {
    if (camera.size == Size{})
        return camera;
    camera.size = size;
    return camera;
}

}  // namespace theatron::capture
