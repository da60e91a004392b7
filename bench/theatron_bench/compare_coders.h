// SPDX-License-Identifier: Apache-2.0
// The colour and the depth of one camera through an encoder and its decoder, picture after picture.
#pragma once

#include <memory>
#include <string>

#include "base/bytes.h"
#include "codec/depth_stream.h"
#include "image/frame.h"
#include "video/color_codec.h"

namespace theatron::bench {

// Both functions throw Error if the codec refuses a picture.
class ColorCoder {
public:
    // The spelling of a colour setting, as "jpeg:quality=85".
    explicit ColorCoder(const std::string& codec);
    ColorCoder(std::unique_ptr<video::ColorEncoder> encoder,
               std::unique_ptr<video::ColorDecoder> decoder);

    // Returns the number of bytes.
    std::size_t encode(const ColorData& color);
    // The picture that was encoded last.
    ColorImage decode();

private:
    std::unique_ptr<video::ColorEncoder> encoder_;
    std::unique_ptr<video::ColorDecoder> decoder_;
    ByteView encoded_;  // of the encoder
    unsigned number_ = 0;
};

// decode() throws Error if the codec refuses its own bytes.
class DepthCoder {
public:
    // The spelling of a depth setting, as "strata".
    explicit DepthCoder(const std::string& codec);

    // Returns the number of bytes.
    std::size_t encode(DepthView depth);
    // The image that was encoded last.
    DepthImage decode();

private:
    codec::DepthStreamEncoder encoder_;
    codec::DepthStreamDecoder decoder_;
    Bytes bytes_;
    codec::EncodedDepth encoded_;
    Size size_;
    unsigned number_ = 0;
};

}  // namespace theatron::bench
