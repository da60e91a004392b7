// SPDX-License-Identifier: Apache-2.0
// libjpeg-turbo behind the interfaces of our colour codecs, as a yardstick for
// our own JPEG codec.
#pragma once

#include <memory>
#include <string>

#include "video/color_codec.h"

namespace theatron::bench {

// Whether a setting is one of JPEG, and what the yardstick's row is called then.
bool has_libjpeg_yardstick(const video::ColorSetting& setting);
std::string libjpeg_name(const std::string& codec);

// For a setting of JPEG. They take only pixels, and are more trusting than ours.
std::unique_ptr<video::ColorEncoder> make_libjpeg_encoder(const video::ColorSetting& setting);
std::unique_ptr<video::ColorDecoder> make_libjpeg_decoder();

}  // namespace theatron::bench
