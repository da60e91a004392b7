// SPDX-License-Identifier: Apache-2.0
// H.264 by the browser's decoders (WebCodecs), which page/video_decoder.js drives: in a page or in
// one of its workers, where they answer in later events.
#pragma once

#include <functional>
#include <memory>

#include "video/color_codec.h"

namespace theatron::video {

struct BrowserDecoders {
    bool has_h264 = false;
    // A decoder has finished or lost a picture: ColorDecoder::poll() and take_failures() tell.
    // Called in an event of its own. Set by the one that polls them.
    std::function<void()> on_news;
};
// Those of this program.
BrowserDecoders& browser_decoders();

// Needs browser_decoders().has_h264. Pictures have the same pixels as in the native build where the
// browser gives their planes.
std::unique_ptr<ColorDecoder> make_browser_h264_decoder();

}  // namespace theatron::video
