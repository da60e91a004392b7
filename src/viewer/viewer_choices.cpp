// SPDX-License-Identifier: Apache-2.0
// Choices of the way of drawing and of the codecs: the next one by a key, or one by its name.
#include <algorithm>

#include "phrases/phrase.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer/viewer.h"

namespace theatron::viewer {
namespace {

// The name after `current` in `names`; `current` may have options behind a colon.
std::string next_name(const std::vector<std::string>& names, const std::string& current) {
    const auto found = std::find(names.begin(), names.end(), current.substr(0, current.find(':')));
    const auto next = found == names.end() || found + 1 == names.end() ? names.begin() : found + 1;
    return *next;
}

}  // namespace

void Viewer::choose_next_renderer(TimePoint now) {
    choose_renderer(next_name(renderer_choices(), choice_.renderer()), now);
}

void Viewer::choose_renderer(const std::string& renderer, TimePoint now) {
    if (!choice_.choose(renderer))
        return note(say(Phrase::host_has_set_this, choice_.renderer()), now);
    options_.renderer = choice_.renderer();
    choose_pace();
    const bool as_drawn = choice_.renderer() == way().renderer;
    note(say(as_drawn ? Phrase::drawing_is_now : Phrase::drawing_is_really, choice_.renderer(),
             way().renderer),
         now);
}

void Viewer::choose_next_depth_codec(TimePoint now) {
    choose_depth_codec(next_name(video::depth_codec_names(), options_.depth_codec), now);
}

void Viewer::choose_depth_codec(const std::string& codec, TimePoint now) {
    options_.depth_codec = codec;
    participant_.choose_codecs(codec, "");
    const auto setting = video::parse_depth_setting(codec).setting;
    note(say(video::make_depth_codec(setting)->lossless() ? Phrase::depth_codec_lossless
                                                          : Phrase::depth_codec_lossy,
             codec),
         now);
}

void Viewer::choose_next_color_codec(TimePoint now) {
    choose_color_codec(next_name(video::color_codec_names(), options_.color_codec));
    note(say(Phrase::color_codec_is, options_.color_codec), now);
}

void Viewer::choose_color_codec(const std::string& codec) {
    options_.color_codec = codec;
    participant_.choose_codecs("", codec);
}

void Viewer::choose_scale(double scale) {
    options_.scale = scale;
    choose_pace();
}

}  // namespace theatron::viewer
