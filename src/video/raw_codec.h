// SPDX-License-Identifier: Apache-2.0
// The part of the codec family that native and web builds share.
#pragma once

#include <memory>

#include "video/color_codec.h"

namespace theatron::video {

// The finished images of a decoder that answers at once, and the memory for the
// next ones. Holds a few at most: a caller that polls too rarely loses the oldest.
class DecodedQueue {
public:
    ColorImage take_blank();
    void put(FrameNumber frame, ColorImage image);
    std::optional<ColorDecoder::Decoded> poll();
    void recycle(ColorImage image);

private:
    static constexpr std::size_t max_kept = 4;
    std::vector<ColorDecoder::Decoded> ready_;
    std::vector<ColorImage> blank_;
};

std::unique_ptr<ColorDecoder> make_raw_decoder();

}  // namespace theatron::video
