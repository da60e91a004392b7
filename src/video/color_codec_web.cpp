// SPDX-License-Identifier: Apache-2.0
// In the browser pictures are received, not sent.
#include "base/error.h"
#include "video/color_codec.h"
#include "video/raw_codec.h"

namespace theatron::video {

std::string missing_color_encoder(const ColorSetting& setting) {
    return "The web build does not encode colour, so there is no '" + setting.text + "'.";
}

std::string missing_color_decoder(const ColorSetting& setting) {
    if (setting.id == ColorCodecId::raw)
        return "";
    return "The web build has no decoder for '" + setting.text + "'.";
}

std::unique_ptr<ColorEncoder> make_color_encoder(const ColorSetting& setting) {
    throw Error(missing_color_encoder(setting));
}

std::unique_ptr<ColorDecoder> make_color_decoder(ColorCodecId id) {
    if (id == ColorCodecId::raw)
        return make_raw_decoder();
    throw Error("The web build has no decoder for colour codec number " + std::to_string(int(id)) +
                ".");
}

}  // namespace theatron::video
