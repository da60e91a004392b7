// SPDX-License-Identifier: Apache-2.0
// All depth codecs: those of codec/ and those that need a video library. Code that
// sends or receives streams uses this header; codec/ itself needs no library that
// some machines lack.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "codec/depth_stream.h"

namespace theatron::video {

// As codec::parse_depth_setting, with "h264:crf=8,near=150,far=65535" besides.
codec::ParsedDepthSetting parse_depth_setting(std::string_view text);

// A text may be understood and still not be possible here. One sentence about
// what is missing, or empty.
std::string missing_depth_encoder(const codec::DepthSetting& setting);
std::string missing_depth_decoder(const codec::DepthSetting& setting);

// Make the codec, or both sides of a stream, of a setting that
// parse_depth_setting gave.
std::unique_ptr<codec::DepthCodec> make_depth_codec(const codec::DepthSetting& setting);
codec::DepthStreamEncoder make_depth_encoder(const codec::DepthSetting& setting);
codec::DepthStreamDecoder make_depth_decoder(const codec::DepthSetting& setting);

// Every name that parse_depth_setting understands in this build.
std::vector<std::string> depth_codec_names();

}  // namespace theatron::video
