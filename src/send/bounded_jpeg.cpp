// SPDX-License-Identifier: Apache-2.0
#include "send/bounded_jpeg.h"

#include <algorithm>
#include <utility>

#include "video/reduced_size.h"

namespace theatron::send {
namespace {

// Each pixel becomes the mean of a square of them.
template <int divisor>
void reduce(ColorView image, MutableColorView out) {
    constexpr int count = divisor * divisor;
    for (int y = 0; y < out.size.height; ++y) {
        Rgb* const to = out.row(y);
        for (int x = 0; x < out.size.width; ++x) {
            int r = count / 2, g = r, b = r;
            for (int dy = 0; dy < divisor; ++dy) {
                const Rgb* const from = image.row(y * divisor + dy) + x * divisor;
                for (int dx = 0; dx < divisor; ++dx) {
                    r += from[dx].r;
                    g += from[dx].g;
                    b += from[dx].b;
                }
            }
            to[x] = {std::uint8_t(r / count), std::uint8_t(g / count), std::uint8_t(b / count)};
        }
    }
}

}  // namespace

Result<ByteView> BoundedJpeg::encode(const ColorData& color) {
    if (color.is_jpeg() && budget_.takes_own(color.jpeg.size()))
        return ByteView(color.jpeg);
    const Result<ColorView> image = pixels_.of(color);
    if (!image)
        return image.error();
    ByteView bytes;
    do
        bytes = encoded_at(budget_.step(), *image);
    while (!budget_.takes(bytes.size()));
    // Its own picture may have become small enough, and is the better one.
    if (color.is_jpeg() && color.jpeg.size() <= bytes.size())
        return ByteView(color.jpeg);
    return bytes;
}

ByteView BoundedJpeg::encoded_at(const JpegBudget::Step& step, ColorView image) {
    // A picture narrower than a square keeps its size, which fits in any case.
    if (step.divisor > 1 && std::min(image.size.width, image.size.height) >= step.divisor) {
        reduced_.resize(video::reduced(image.size, step.divisor));
        step.divisor == 2 ? reduce<2>(image, reduced_.view()) : reduce<4>(image, reduced_.view());
        image = std::as_const(reduced_).view();
    }
    if (step.quality != quality_) {
        compressor_ = std::make_unique<video::JpegCompressor>(step.quality, true);
        quality_ = step.quality;
    }
    return compressor_->compress(image);
}

}  // namespace theatron::send
