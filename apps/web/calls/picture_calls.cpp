// SPDX-License-Identifier: Apache-2.0
// The functions that page/picture.js calls for the panel "Picture".
#include <emscripten/emscripten.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/steady_clock.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"
#include "viewer/renderer_text.h"
#include "visit.h"

using namespace theatron;
using theatron::web::page;

namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_color(const std::string& value) {
    return value == video::auto_color || video::parse_color_setting(value).problem.empty();
}

void choose(web::Visit& visit, std::string_view what, const std::string& value) {
    const TimePoint now = steady_now();
    if (what == "renderer" && has(viewer::renderer_choices(), value))
        visit.viewer.choose_renderer(value, now);
    if (what == "depth" && has(video::depth_codec_names(), value))
        visit.viewer.choose_depth_codec(value, now);
    if (what == "scale")
        visit.viewer.choose_scale(std::clamp(std::strtod(value.c_str(), nullptr), 0.0, 1.0));
    if (what == "color" && is_color(value)) {
        visit.color.choose(value);
        visit.viewer.choose_color_codec(visit.color.codec());
    }
}

}  // namespace

extern "C" {

// Names to choose from: {"renderer":[],"depth":[],"color":[]}.
EMSCRIPTEN_KEEPALIVE const char* theatron_picture_choices() {
    page().text = nlohmann::json{{"renderer", viewer::renderer_choices()},
                                 {"depth", video::depth_codec_names()},
                                 {"color", video::color_codec_names()}}
                      .dump();
    return page().text.c_str();
}

// The person's choice of "renderer", "depth", "color" or "scale"; others have no effect. In the 2D
// view there is only colour.
EMSCRIPTEN_KEEPALIVE void theatron_choose(const char* what, const char* value) {
    if (page().visit)
        web::guarded([&] { choose(*page().visit, what, value); });
    if (page().flat && std::string_view(what) == "color" && is_color(value))
        web::guarded([&] {
            page().flat->color.choose(value);
            page().flat->participant.choose_codecs("", page().flat->color.codec());
        });
}

}  // extern "C"
