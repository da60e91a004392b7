// SPDX-License-Identifier: Apache-2.0
#include "compare_coders.h"

#include <utility>

#include "base/error.h"
#include "video/depth_codecs.h"

namespace theatron::bench {

ColorCoder::ColorCoder(const std::string& codec)
    : ColorCoder(video::make_color_encoder(video::parse_color_setting(codec).setting),
                 video::make_color_decoder(video::parse_color_setting(codec).setting.id)) {}

ColorCoder::ColorCoder(std::unique_ptr<video::ColorEncoder> encoder,
                       std::unique_ptr<video::ColorDecoder> decoder)
    : encoder_(std::move(encoder)), decoder_(std::move(decoder)) {}

std::size_t ColorCoder::encode(const ColorData& color) {
    const auto encoded = encoder_->encode(color, number_ == 0);
    if (!encoded)
        throw Error("A picture of the generated room could not be compressed.");
    encoded_ = encoded->bytes;
    return encoded_.size();
}

ColorImage ColorCoder::decode() {
    if (decoder_->submit(encoded_, FrameNumber(number_++)) == Status::ok)
        if (auto decoded = decoder_->poll())
            return std::move(decoded->image);
    throw Error("A picture of the generated room did not come back.");
}

DepthCoder::DepthCoder(const std::string& codec)
    : encoder_(video::make_depth_encoder(video::parse_depth_setting(codec).setting)),
      decoder_(video::make_depth_decoder(video::parse_depth_setting(codec).setting)) {}

std::size_t DepthCoder::encode(DepthView depth) {
    size_ = depth.size;
    bytes_.resize(encoder_.max_encoded_size(size_));
    encoded_ = encoder_.encode(depth, FrameNumber(number_), number_ == 0, bytes_);
    ++number_;
    return encoded_.bytes;
}

DepthImage DepthCoder::decode() {
    DepthImage depth(size_);
    if (decoder_.decode(encoded_, ByteView(bytes_).first(encoded_.bytes), depth.view()) !=
        Status::ok)
        throw Error("Depth of the generated room did not come back.");
    return depth;
}

}  // namespace theatron::bench
