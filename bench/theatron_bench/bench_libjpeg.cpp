// SPDX-License-Identifier: Apache-2.0
#include "bench_libjpeg.h"

#include <turbojpeg.h>

#include "base/error.h"
#include "video/color_setting.h"

namespace theatron::bench {
namespace {

class Library {
public:
    explicit Library(tjhandle handle) : handle_(handle) {
        if (!handle_)
            throw Error("libjpeg-turbo cannot be used; is memory exhausted?");
    }
    Library(const Library&) = delete;
    ~Library() { tjDestroy(handle_); }
    tjhandle get() const { return handle_; }

private:
    tjhandle handle_;
};

class Encoder final : public video::ColorEncoder {
public:
    explicit Encoder(const video::JpegParams& params) : params_(params) {}

    Result<video::EncodedColor> encode(const ColorData& color, bool) override {
        const int subsampling = params_.halve_chroma ? TJSAMP_420 : TJSAMP_444;
        const auto [width, height] = color.size;
        bytes_.resize(tjBufSize(width, height, subsampling));
        auto* to = reinterpret_cast<unsigned char*>(bytes_.data());
        auto used = static_cast<unsigned long>(bytes_.size());
        if (tjCompress2(library_.get(), &color.pixels.pixels.data()->r, width, 0, height, TJPF_RGB,
                        &to, &used, subsampling, params_.quality,
                        TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT))
            return Status::malformed;
        return video::EncodedColor{ByteView(bytes_).first(used)};
    }

private:
    video::JpegParams params_;
    Library library_{tjInitCompress()};
    Bytes bytes_;
};

class Decoder final : public video::ColorDecoder {
public:
    Status submit(ByteView encoded, FrameNumber frame) override {
        const auto* from = reinterpret_cast<const unsigned char*>(encoded.data());
        Size size;
        int subsampling = 0, colors = 0;
        if (tjDecompressHeader3(library_.get(), from, encoded.size(), &size.width, &size.height,
                                &subsampling, &colors))
            return Status::malformed;
        decoded_.frame = frame;
        decoded_.image.resize(size);
        if (tjDecompress2(library_.get(), from, encoded.size(), &decoded_.image.pixels.data()->r,
                          size.width, 0, size.height, TJPF_RGB, TJFLAG_ACCURATEDCT))
            return Status::malformed;
        waiting_ = true;
        return Status::ok;
    }

    std::optional<Decoded> poll() override {
        if (!std::exchange(waiting_, false))
            return std::nullopt;
        return std::move(decoded_);
    }

    void recycle(ColorImage image) override { decoded_.image = std::move(image); }

private:
    Library library_{tjInitDecompress()};
    Decoded decoded_;
    bool waiting_ = false;
};

}  // namespace

bool has_libjpeg_yardstick(const video::ColorSetting& setting) {
    return setting.id == video::ColorCodecId::jpeg;
}

std::string libjpeg_name(const std::string& codec) {
    return "libjpeg_turbo" + codec.substr(std::string("jpeg").size());
}

std::unique_ptr<video::ColorEncoder> make_libjpeg_encoder(const video::ColorSetting& setting) {
    Options options = Options::parse(setting.text);
    return std::make_unique<Encoder>(video::take_jpeg_params(options));
}

std::unique_ptr<video::ColorDecoder> make_libjpeg_decoder() {
    return std::make_unique<Decoder>();
}

}  // namespace theatron::bench
