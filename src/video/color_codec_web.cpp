// SPDX-License-Identifier: Apache-2.0
// In the browser pictures are received, not sent.
#include "base/error.h"
#include "video/browser_decoders_web.h"
#include "video/color_codec.h"
#include "video/jpeg_decoder.h"
#include "video/raw_codec.h"

namespace theatron::video {
namespace {

class JpegDecoder final : public ColorDecoder {
public:
    Status submit(ByteView encoded, FrameNumber frame) override {
        ColorImage image = queue_.take_blank();
        const Status status = decoder_.decode(encoded, image);
        if (status == Status::ok)
            queue_.put(frame, std::move(image));
        else
            queue_.recycle(std::move(image));
        return status;
    }
    std::optional<Decoded> poll() override { return queue_.poll(); }
    void recycle(ColorImage image) override { queue_.recycle(std::move(image)); }

private:
    BaselineJpegDecoder decoder_;
    DecodedQueue queue_;
};

}  // namespace

std::string missing_color_encoder(const ColorSetting& setting) {
    return "The web build does not encode colour, so there is no '" + setting.text + "'.";
}

std::string missing_color_decoder(const ColorSetting& setting) {
    if (setting.id == ColorCodecId::raw || setting.id == ColorCodecId::jpeg)
        return "";
    if (setting.id == ColorCodecId::h264)
        return browser_decoders().has_h264 ? "" : "This browser does not decode H.264.";
    return "The web build has no decoder for '" + setting.text + "'.";
}

std::unique_ptr<ColorEncoder> make_color_encoder(const ColorSetting& setting) {
    throw Error(missing_color_encoder(setting));
}

std::unique_ptr<ColorDecoder> make_color_decoder(ColorCodecId id) {
    if (id == ColorCodecId::raw)
        return make_raw_decoder();
    if (id == ColorCodecId::jpeg)
        return std::make_unique<JpegDecoder>();
    if (id == ColorCodecId::h264 && browser_decoders().has_h264)
        return make_browser_h264_decoder();
    throw Error("The web build has no decoder for colour codec number " + std::to_string(int(id)) +
                ".");
}

}  // namespace theatron::video
