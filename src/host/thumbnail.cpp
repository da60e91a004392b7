// SPDX-License-Identifier: Apache-2.0
#include "host/thumbnail.h"

#include <algorithm>
#include <utility>

#include "files/png_file.h"
#include "video/jpeg_native.h"

namespace theatron::host {

ColorImage small_picture(ColorView picture, int width) {
    const int step = std::max(1, (picture.size.width + width - 1) / width);
    ColorImage small(Size{picture.size.width / step, picture.size.height / step});
    for (int y = 0; y < small.size.height; ++y)
        for (int x = 0; x < small.size.width; ++x)
            small.view().row(y)[x] = picture.row(y * step)[x * step];
    return small;
}

void Thumbnail::on_frame(const FramePtr& frame, TimePoint now) {
    if (frame->color.empty())
        return;
    const std::lock_guard lock(mutex_);
    if (taken_ != TimePoint{} && now - taken_ < interval)
        return;
    taken_ = now;
    color_ = {};
    if (frame->color.is_jpeg())
        color_.jpeg = frame->color.jpeg;
    else
        color_.pixels = small_picture(frame->color.pixels.view(), width);
    is_new_ = true;
}

std::string Thumbnail::png() {
    ColorData color;
    {
        const std::lock_guard lock(mutex_);
        if (!std::exchange(is_new_, false))
            return png_;
        color = color_;
    }
    if (color.is_jpeg()) {
        ColorImage decoded;
        if (video::JpegDecompressor().decompress(color.jpeg, decoded) != Status::ok)
            return "";
        color.pixels = small_picture(decoded.view(), width);
    }
    if (!is_valid(color.pixels.size))
        return "";
    const Bytes bytes = files::encode_png(color.pixels.view());
    const std::lock_guard lock(mutex_);
    png_.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return png_;
}

}  // namespace theatron::host
