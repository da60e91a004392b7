// SPDX-License-Identifier: Apache-2.0
#include <cassert>

#include "base/error.h"
#include "video/avc_native.h"
#include "video/camera_pixels_native.h"
#include "video/color_codec.h"
#include "video/color_raw.h"
#include "video/color_setting.h"
#include "video/h264_native.h"
#include "video/jpeg_encoder_native.h"
#include "video/raw_codec.h"

namespace theatron::video {
namespace {

class RawEncoder final : public ColorEncoder {
public:
    Result<EncodedColor> encode(const ColorData& color, bool) override {
        const Result<ColorView> image = pixels_.of(color);
        if (!image)
            return image.error();
        bytes_.resize(color_raw::encoded_size(image->size));
        color_raw::encode(*image, bytes_);
        return EncodedColor{bytes_};
    }

private:
    CameraPixels pixels_;
    Bytes bytes_;
};

class JpegEncoder final : public ColorEncoder {
public:
    explicit JpegEncoder(const JpegParams& params)
        : pass_(params.pass), compressor_(params.quality, params.halve_chroma) {}

    Result<EncodedColor> encode(const ColorData& color, bool) override {
        if (pass_ && color.is_jpeg())
            return EncodedColor{color.jpeg};
        const Result<ColorView> image = pixels_.of(color);
        if (!image)
            return image.error();
        const ByteView encoded = compressor_.compress(*image);
        // A camera's picture of lower quality than was asked for would only grow.
        if (color.is_jpeg() && encoded.size() >= color.jpeg.size())
            return EncodedColor{color.jpeg};
        return EncodedColor{encoded};
    }

private:
    bool pass_;
    CameraPixels pixels_;
    JpegCompressor compressor_;
};

class JpegDecoder final : public ColorDecoder {
public:
    Status submit(ByteView encoded, FrameNumber frame) override {
        ColorImage image = queue_.take_blank();
        const Status status = decompressor_.decompress(encoded, image);
        if (status == Status::ok)
            queue_.put(frame, std::move(image));
        else
            queue_.recycle(std::move(image));
        return status;
    }
    std::optional<Decoded> poll() override { return queue_.poll(); }
    void recycle(ColorImage image) override { queue_.recycle(std::move(image)); }

private:
    JpegDecompressor decompressor_;
    DecodedQueue queue_;
};

[[noreturn]] void refuse(ColorCodecId id) {
    throw Error("This build has no colour codec number " + std::to_string(int(id)) + ".");
}

}  // namespace

std::string missing_color_encoder(const ColorSetting& setting) {
    if (setting.id != ColorCodecId::h264)
        return "";
    Options options = Options::parse(setting.text);
    std::string problem;
    return AvcEncoder::problem(take_h264_params(options, problem).encoder);
}

std::string missing_color_decoder(const ColorSetting& setting) {
    return setting.id == ColorCodecId::h264 ? AvcDecoder::problem() : "";
}

std::unique_ptr<ColorEncoder> make_color_encoder(const ColorSetting& setting) {
    switch (setting.id) {
        case ColorCodecId::raw:
            return std::make_unique<RawEncoder>();
        case ColorCodecId::jpeg: {
            Options options = Options::parse(setting.text);
            return std::make_unique<JpegEncoder>(take_jpeg_params(options));
        }
        case ColorCodecId::h264:
            return make_h264_encoder(setting);
    }
    refuse(setting.id);
}

std::unique_ptr<ColorDecoder> make_color_decoder(ColorCodecId id) {
    switch (id) {
        case ColorCodecId::raw:
            return make_raw_decoder();
        case ColorCodecId::jpeg:
            return std::make_unique<JpegDecoder>();
        case ColorCodecId::h264:
            return make_h264_decoder();
    }
    refuse(id);
}

}  // namespace theatron::video
