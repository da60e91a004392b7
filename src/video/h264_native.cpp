// SPDX-License-Identifier: Apache-2.0
#include "video/h264_native.h"

#include <turbojpeg.h>

#include "base/error.h"
#include "video/avc_native.h"
#include "video/camera_pixels_native.h"
#include "video/color_setting.h"
#include "video/h264_header.h"
#include "video/raw_codec.h"

namespace theatron::video {
namespace {

// Between RGB and planes with half the colour, in the colour space of JPEG, by
// the vector code of libjpeg-turbo.
class PlaneConverter {
public:
    PlaneConverter() {
        if (!to_planes_ || !from_planes_)
            throw Error("libjpeg-turbo gives no converter; is memory exhausted?");
    }
    ~PlaneConverter() {
        tjDestroy(to_planes_);
        tjDestroy(from_planes_);
    }
    PlaneConverter(const PlaneConverter&) = delete;
    PlaneConverter& operator=(const PlaneConverter&) = delete;

    // Odd sides are filled up with the last row and column.
    Status to_planes(ColorView image, const AvcPlanes& planes) {
        auto [pixels, strides] = plane_arguments(planes);
        const int failed = tjEncodeYUVPlanes(
            to_planes_, reinterpret_cast<const unsigned char*>(image.pixels), image.size.width,
            int(image.stride) * int(sizeof(Rgb)), image.size.height, TJPF_RGB, pixels.data(),
            strides.data(), TJSAMP_420, 0);
        return failed ? Status::unsupported : Status::ok;
    }
    Status from_planes(const AvcPlanes& planes, MutableColorView image) {
        auto [pixels, strides] = plane_arguments(planes);
        const unsigned char* from[] = {pixels[0], pixels[1], pixels[2]};
        const int failed =
            tjDecodeYUVPlanes(from_planes_, from, strides.data(), TJSAMP_420,
                              reinterpret_cast<unsigned char*>(image.pixels), image.size.width,
                              int(image.stride) * int(sizeof(Rgb)), image.size.height, TJPF_RGB, 0);
        return failed ? Status::unsupported : Status::ok;
    }

private:
    static std::pair<std::array<unsigned char*, 3>, std::array<int, 3>> plane_arguments(
        const AvcPlanes& planes) {
        return {{planes[0].pixels, planes[1].pixels, planes[2].pixels},
                {int(planes[0].stride), int(planes[1].stride), int(planes[2].stride)}};
    }

    tjhandle to_planes_ = tjInitCompress();
    tjhandle from_planes_ = tjInitDecompress();
};

class H264Encoder final : public ColorEncoder {
public:
    explicit H264Encoder(const AvcParams& params) : encoder_(params) {}

    Result<EncodedColor> encode(const ColorData& color, bool key) override {
        const Result<ColorView> image = pixels_.of(color);
        if (!image)
            return image.error();
        const Size coded = coded_size(image->size);
        if (encoder_.size() != coded)
            if (const Status s = encoder_.open(coded, AvcLayout::yuv420); s != Status::ok)
                return s;
        if (const Status s = converter_.to_planes(*image, encoder_.planes()); s != Status::ok)
            return s;
        const auto encoded = encoder_.encode(key || image->size != shown_);
        if (!encoded)
            return encoded.error();
        shown_ = image->size;
        bytes_.resize(h264_header_size);
        put_h264_header(encoded->key, shown_, bytes_.data());
        bytes_.insert(bytes_.end(), encoded->bytes.begin(), encoded->bytes.end());
        return EncodedColor{bytes_, encoded->key};
    }

private:
    CameraPixels pixels_;
    PlaneConverter converter_;
    AvcEncoder encoder_;
    Size shown_;
    Bytes bytes_;
};

class H264Decoder final : public ColorDecoder {
public:
    Status submit(ByteView encoded, FrameNumber frame) override {
        const auto picture = read_h264_picture(encoded);
        if (!picture)
            return picture.error();
        if (const Status s =
                decoder_.decode(picture->access_unit, coded_size(picture->size), AvcLayout::yuv420);
            s != Status::ok)
            return s;
        ColorImage image = queue_.take_blank();
        image.resize(picture->size);
        const Status status = converter_.from_planes(decoder_.planes(), image.view());
        if (status == Status::ok)
            queue_.put(frame, std::move(image));
        return status;
    }
    std::optional<Decoded> poll() override { return queue_.poll(); }
    void recycle(ColorImage image) override { queue_.recycle(std::move(image)); }

private:
    AvcDecoder decoder_;
    PlaneConverter converter_;
    DecodedQueue queue_;
};

}  // namespace

std::unique_ptr<ColorEncoder> make_h264_encoder(const ColorSetting& setting) {
    Options options = Options::parse(setting.text);
    std::string problem;
    return std::make_unique<H264Encoder>(take_h264_params(options, problem));
}

std::unique_ptr<ColorDecoder> make_h264_decoder() {
    return std::make_unique<H264Decoder>();
}

}  // namespace theatron::video
