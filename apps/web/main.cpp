// SPDX-License-Identifier: Apache-2.0
// The functions that page/page.js calls: join, one picture, input, and what the panels show.
//
// The page has one thread; everything runs in its events.
#include <GLES3/gl3.h>
#include <emscripten/emscripten.h>
#include <emscripten/html5.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/steady_clock.h"
#include "page_input.h"
#include "page_state.h"
#include "xr/scaled_picture.h"

namespace theatron::web {
namespace {

// A page that joined.
struct Visit {
    Visit(client::Participant::Options join, std::string host_address)
        : address(std::move(host_address)),
          options(viewer_options(join)),
          participant(std::move(join)),
          viewer(options, participant) {}

    static viewer::Viewer::Options viewer_options(const client::Participant::Options& join) {
        viewer::Viewer::Options options;
        options.depth_codec = join.depth_codec;
        options.color_codec = join.color_codec;
        options.shows_people = true;
        return options;
    }

    std::string address;
    viewer::Viewer::Options options;
    client::Participant participant;
    viewer::Viewer viewer;
    xr::ScaledPicture picture;
};

// The page's state. Objects of GL must not outlive their context, so nothing is destroyed when the
// page is closed.
struct Page {
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
    std::unique_ptr<Visit> visit;
    xr::WindowInput input;  // since the last picture
    std::string problem;    // why the visit ended; a sentence
    std::string text;       // that the last function returned
};

Page& page() {
    static auto* const only = new Page;
    return *only;
}

// Runs `work`; an exception ends the visit with its sentence.
template <class Work>
void guarded(Work work) {
    try {
        work();
    } catch (const std::exception& e) {
        page().problem = e.what();
        page().visit.reset();
    }
}

void open_context() {
    if (page().context != 0)
        return;
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    attributes.alpha = attributes.depth = attributes.antialias = EM_FALSE;
    attributes.powerPreference = EM_WEBGL_POWER_PREFERENCE_HIGH_PERFORMANCE;
    const auto context = emscripten_webgl_create_context("#view", &attributes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS)
        throw Error("This browser has no WebGL 2; use a newer one, or theatron join.");
    page().context = context;
}

// The digits are not checked: the page made them itself.
Bytes bytes_of_hex(const std::string& digits) {
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(std::byte(std::strtoul(digits.substr(i, 2).c_str(), nullptr, 16)));
    return bytes;
}

client::Participant::Options join_options(const net::Link& link, const char* name,
                                          const char* person) {
    client::Participant::Options options;
    options.link = link;
    options.name = name;
    options.keeps_room = options.keeps_cases = true;
    options.person = bytes_of_hex(person);
    options.remark = [](const std::string& text) {
        std::puts(text.c_str());
        if (page().visit)
            page().visit->viewer.note(text, steady_now());
    };
    return options;
}

bool draw(Visit& visit, Size size) {
    const TimePoint now = steady_now();
    const xr::WindowInput input = std::exchange(page().input, {});
    page().input.pointer = input.pointer;
    page().input.aims_teleport = input.aims_teleport;
    page().input.points = input.points;
    page().input.steering.fly = input.steering.fly;
    page().input.steering.fast = input.steering.fast;
    visit.viewer.on_input(
        input, input.grabbed ? visit.picture.distance_at(*input.grabbed) : std::nullopt, size, now);
    const bool changed = visit.viewer.step(size, now);
    if (!changed && !input.redraw)
        return false;
    if (changed)
        visit.viewer.draw(size, visit.picture.begin(size, visit.viewer.way().scale), now);
    visit.picture.show(size);
    // The driver works later: without this the time of drawing would look like nothing.
    glFinish();
    if (changed)
        visit.viewer.on_presented(now, steady_now());
    return changed;
}

}  // namespace
}  // namespace theatron::web

using namespace theatron;
using theatron::web::page;

extern "C" {

// `port` of the page; `token` as in the link; `person` in hex digits. See problem() for failures.
EMSCRIPTEN_KEEPALIVE void theatron_join(const char* host, int port, const char* token,
                                        const char* name, const char* person) {
    page().problem.clear();
    page().visit.reset();
    web::guarded([&] {
        web::open_context();
        const net::Link link{host, std::uint16_t(port), token, ""};
        page().visit = std::make_unique<web::Visit>(web::join_options(link, name, person),
                                                    link.host + ":" + std::to_string(link.port));
    });
}

EMSCRIPTEN_KEEPALIVE void theatron_leave() {
    web::guarded([] { page().visit.reset(); });
}

// One picture in the page's rhythm: pixels of the canvas. 1 if a new one was drawn.
EMSCRIPTEN_KEEPALIVE int theatron_draw(int width, int height) {
    bool drawn = false;
    if (page().visit)
        web::guarded([&] { drawn = web::draw(*page().visit, {width, height}); });
    return drawn ? 1 : 0;
}

// JSON for the panels: page_state.h, or {"problem": sentence} without a visit.
EMSCRIPTEN_KEEPALIVE const char* theatron_state() {
    nlohmann::json state;
    if (page().visit)
        web::guarded([&] {
            state = web::page_state(page().visit->viewer, page().visit->participant,
                                    page().visit->address, steady_now());
        });
    if (!page().visit)
        state = {{"phase", "left"}, {"problem", page().problem}};
    page().text = state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return page().text.c_str();
}

// A button of a panel.
EMSCRIPTEN_KEEPALIVE void theatron_command(int command) {
    if (page().visit)
        web::guarded([&] { page().visit->viewer.press(command, steady_now()); });
}

// Input. Places are shares of the canvas from its upper left corner, ways are shares of its height.
EMSCRIPTEN_KEEPALIVE void theatron_key(const char* key, const char* code) {
    if (const auto press = web::pressed(key, code))
        page().input.keys.push_back(*press);
}
EMSCRIPTEN_KEEPALIVE void theatron_hold(double right, double up, double ahead, int fast,
                                        int teleport, int points) {
    page().input.steering.fly = {right, up, ahead};
    page().input.steering.fast = fast != 0;
    page().input.aims_teleport = teleport != 0;
    page().input.points = points != 0;
}
EMSCRIPTEN_KEEPALIVE void theatron_point(double x, double y) {
    page().input.pointer = Vec2{x, y};
}
EMSCRIPTEN_KEEPALIVE void theatron_grab(double x, double y, int left) {
    page().input.pointer = page().input.grabbed = Vec2{x, y};
    page().input.grabbed_left = left != 0;
}
EMSCRIPTEN_KEEPALIVE void theatron_release() {
    page().input.released = true;
}
EMSCRIPTEN_KEEPALIVE void theatron_drag(double x, double y, int turns) {
    Vec2& way = turns ? page().input.steering.turn : page().input.steering.slide;
    way = {way.x + x, way.y + y};
}
EMSCRIPTEN_KEEPALIVE void theatron_wheel(double clicks) {
    page().input.steering.approach += clicks;
}
// The canvas has lost its content.
EMSCRIPTEN_KEEPALIVE void theatron_redraw() {
    page().input.redraw = true;
}

}  // extern "C"

int main() {
    return 0;
}
