// SPDX-License-Identifier: Apache-2.0
// libjpeg-turbo as codecs with our interfaces: the yardstick of our own JPEG codec.
#pragma once

#include <memory>
#include <string>

#include "video/color_codec.h"

namespace theatron::bench {

// True for JPEG settings; and the name of the yardstick's row.
bool has_libjpeg_yardstick(const video::ColorSetting& setting);
std::string libjpeg_name(const std::string& codec);

// Codecs for a JPEG setting. They accept pixels only, and check their input less than ours.
std::unique_ptr<video::ColorEncoder> make_libjpeg_encoder(const video::ColorSetting& setting);
std::unique_ptr<video::ColorDecoder> make_libjpeg_decoder();

}  // namespace theatron::bench
