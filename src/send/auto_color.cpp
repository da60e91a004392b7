// SPDX-License-Identifier: Apache-2.0
#include "send/auto_color.h"

#include "base/error.h"
#include "send/bounded_jpeg.h"

namespace theatron::send {
namespace {

std::unique_ptr<video::ColorEncoder> make(std::string_view setting) {
    return video::make_color_encoder(video::parse_color_setting(setting).setting);
}

class AutoEncoder final : public video::ColorEncoder {
public:
    AutoEncoder(std::shared_ptr<const AutoColor> is_h264, const JpegLimits& limits)
        : is_h264_(std::move(is_h264)), jpeg_(limits) {}

    Result<video::EncodedColor> encode(const ColorData& color, bool key) override {
        if (*is_h264_ && !h264_failed_) {
            const bool begins = !h264_;
            if (begins)
                h264_ = make(auto_h264);
            auto encoded = h264_->encode(color, key || begins);
            if (encoded) {
                encoded->codec = video::ColorCodecId::h264;
                return encoded;
            }
            // A camera's damaged picture is no failure of the encoder.
            if (encoded.error() == Status::malformed)
                return encoded;
            h264_failed_ = true;
        }
        h264_.reset();
        const Result<ByteView> encoded = jpeg_.encode(color);
        if (!encoded)
            return encoded.error();
        return video::EncodedColor{*encoded, true, video::ColorCodecId::jpeg};
    }

private:
    const std::shared_ptr<const AutoColor> is_h264_;
    BoundedJpeg jpeg_;
    std::unique_ptr<video::ColorEncoder> h264_;
    bool h264_failed_ = false;
};

}  // namespace

std::unique_ptr<video::ColorEncoder> make_auto_encoder(std::shared_ptr<const AutoColor> is_h264,
                                                       const JpegLimits& limits) {
    return std::make_unique<AutoEncoder>(std::move(is_h264), limits);
}

}  // namespace theatron::send
