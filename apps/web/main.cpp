// SPDX-License-Identifier: Apache-2.0
// The functions that page/page.js calls: join, one picture, input, and what the panels show. Those
// for a headset, for the person's voice and face, for the panel of the picture, and for decoding
// workers are in calls/.
//
// The page has one thread; everything but decoding runs in its events. Its decoding workers run the
// same program, of which they call the functions of calls/decoder_calls.cpp alone.
#include <emscripten/emscripten.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "base/steady_clock.h"
#include "page_input.h"
#include "page_state.h"
#include "phrases/language.h"
#include "phrases/phrase.h"
#include "render/font_atlas_web.h"
#include "visit.h"

using namespace theatron;
using theatron::web::page;

extern "C" {

// The language of all that follows, as the browser names it: "de-AT".
EMSCRIPTEN_KEEPALIVE void theatron_use_language(const char* language) {
    set_language(parse_language(language).value_or(Language::english));
}

// From now on the person has no keyboard: no sentence names keys.
EMSCRIPTEN_KEEPALIVE void theatron_use_touch() {
    set_by_touch(true);
}

// `port` of the page; `token` as in the link; `person` in hex digits; `depth` as ask_for_depth()
// and `color` as PageColor takes it; `scale` as Visit does. `can_h264`: this page or its workers
// have decoders of the browser. The state has the reason of a failure.
EMSCRIPTEN_KEEPALIVE void theatron_join(const char* host, int port, const char* token,
                                        const char* name, const char* person, const char* depth,
                                        const char* color, int can_h264, double scale) {
    page().problem.clear();
    page().leave();
    web::guarded([&] {
        web::open_context();
        const net::Link link{host, std::uint16_t(port), token, ""};
        const web::PageColor asked(color, can_h264 != 0);
        client::Participant::Options join = web::join_options(link, name, person, asked);
        const std::string problem = web::ask_for_depth(join, depth);
        page().visit =
            std::make_unique<web::Visit>(std::move(join), net::host_and_port(link), asked, scale);
        if (!problem.empty())
            page().visit->viewer.note(problem, steady_now());
    });
}

// The same for the 2D view (flat_view.h), which needs no WebGL and shows no depth.
EMSCRIPTEN_KEEPALIVE void theatron_join_flat(const char* host, int port, const char* token,
                                             const char* name, const char* person,
                                             const char* color, int can_h264) {
    page().problem.clear();
    page().leave();
    web::guarded([&] {
        const net::Link link{host, std::uint16_t(port), token, ""};
        const web::PageColor asked(color, can_h264 != 0);
        page().flat = std::make_unique<web::FlatVisit>(web::join_options(link, name, person, asked),
                                                       net::host_and_port(link), asked);
    });
}

// The 2D view's picture if it is a new one, else null: 4 bytes for each of these pixels.
EMSCRIPTEN_KEEPALIVE const std::byte* theatron_flat_picture() {
    bool is_new = false;
    if (page().flat)
        web::guarded([&] { is_new = page().flat->view.take(steady_now()); });
    return is_new && page().flat ? page().flat->view.pixels().data() : nullptr;
}

EMSCRIPTEN_KEEPALIVE int theatron_flat_width() {
    return page().flat ? page().flat->view.size().width : 0;
}

EMSCRIPTEN_KEEPALIVE int theatron_flat_height() {
    return page().flat ? page().flat->view.size().height : 0;
}

EMSCRIPTEN_KEEPALIVE void theatron_flat_next() {
    if (page().flat)
        page().flat->view.next_camera();
}

// In the page's rhythm: what the person does over the picture, and what is drawn over it, as JSON
// for page/flat_marks.js; "": as before.
EMSCRIPTEN_KEEPALIVE const char* theatron_flat_step() {
    page().text.clear();
    if (page().flat)
        web::guarded([] { page().text = page().flat->view.step(page().input, steady_now()); });
    return page().text.c_str();
}

// The person has chosen to point, or does so no longer.
EMSCRIPTEN_KEEPALIVE void theatron_flat_points(int expected) {
    if (page().flat)
        page().flat->view.expect_pointing(expected != 0);
}

// The stay is over: nothing of it goes on with the next one.
EMSCRIPTEN_KEEPALIVE void theatron_leave() {
    web::guarded([] {
        page().leave();
        page().chat = {};
        page().hand_raised = false;
    });
}

// For the joins that follow: 16 hex digits, as in wire::Join::run. Another number is another stay.
EMSCRIPTEN_KEEPALIVE void theatron_use_run(const char* hex) {
    page().run = std::strtoull(hex, nullptr, 16);
}

// In the page's rhythm, with the pixels of the canvas: begins the next picture unless the GPU still
// works on one. 1 while it does, and 2 more if this call has drawn the canvas.
EMSCRIPTEN_KEEPALIVE int theatron_draw(int width, int height) {
    bool is_drawn = false;
    if (page().visit)
        web::guarded([&] { is_drawn = web::draw(*page().visit, {width, height}); });
    return int(page().visit && page().visit->drawing.is_waiting()) | int(is_drawn) << 1;
}

// In the page's rhythm, also while the GPU draws: a step of the work on the room. The clouds come
// first.
EMSCRIPTEN_KEEPALIVE void theatron_prepare() {
    if (page().visit && page().visit->viewer.pictures() > 0 && render::prepare_font_atlas())
        web::guarded([] { page().visit->viewer.prepare(!page().visit->drawing.is_waiting()); });
}

// 1 if the GPU has finished a picture since the last call.
EMSCRIPTEN_KEEPALIVE int theatron_finish_drawing() {
    bool finished = false;
    if (page().visit)
        web::guarded([&] { finished = web::finish_drawing(*page().visit); });
    return finished ? 1 : 0;
}

// JSON for the panels: page_state.h, or {"problem": sentence} without a visit.
EMSCRIPTEN_KEEPALIVE const char* theatron_state() {
    nlohmann::json state;
    const TimePoint now = steady_now();
    if (page().visit)
        web::guarded([&] {
            web::Visit& visit = *page().visit;
            viewer::Facts facts = visit.viewer.facts(now);
            facts.line = true;  // the page itself decides where it shows them
            web::follow_color(visit, facts.received, now);
            state =
                web::page_state(visit.viewer, std::move(facts), visit.participant, visit.address);
            visit.color.add_to(state);
        });
    if (page().flat)
        web::guarded([&] {
            web::FlatVisit& visit = *page().flat;
            viewer::Facts facts = visit.view.facts(now);
            web::follow_color(visit, facts.received, now);
            state = visit.view.state(std::move(facts), visit.address);
            visit.color.add_to(state);
        });
    if (!page().participant())
        state = {{"phase", "left"}, {"problem", page().problem}};
    page().text = state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return page().text.c_str();
}

// Rates, ages and drops begin anew; for measurements.
EMSCRIPTEN_KEEPALIVE void theatron_reset_figures() {
    if (page().participant())
        page().participant()->reset_figures();
}

// A button of a panel.
EMSCRIPTEN_KEEPALIVE void theatron_command(int command) {
    if (page().visit)
        web::guarded([&] { page().visit->viewer.press(command, steady_now()); });
    if (page().flat)
        web::guarded([&] { page().flat->view.press(command, steady_now()); });
}

// Input. Places are shares of the canvas from its upper left corner, ways are shares of its height.
// A canvas that is not shown has no size, so that they are no numbers: such input is left out.
EMSCRIPTEN_KEEPALIVE void theatron_key(const char* key, const char* code) {
    if (const auto press = web::pressed(key, code))
        page().input.press(*press);
}
EMSCRIPTEN_KEEPALIVE void theatron_hold(double right, double up, double ahead, int fast,
                                        int teleport, int points) {
    window::WindowInput& input = page().input.newest();
    input.steering.fly = {right, up, ahead};
    input.steering.fast = fast != 0;
    input.aims_teleport = teleport != 0;
    input.points = points != 0;
}
EMSCRIPTEN_KEEPALIVE void theatron_point(double x, double y) {
    if (std::isfinite(x) && std::isfinite(y))
        page().input.move({x, y});
}
EMSCRIPTEN_KEEPALIVE void theatron_grab(double x, double y, int left) {
    if (!std::isfinite(x) || !std::isfinite(y))
        return;
    page().input.grab({x, y}, left != 0);
    page().input.move({x, y});
}
EMSCRIPTEN_KEEPALIVE void theatron_release() {
    page().input.release();
}
EMSCRIPTEN_KEEPALIVE void theatron_drag(double x, double y, int turns) {
    if (!std::isfinite(x) || !std::isfinite(y))
        return;
    window::Steering& steering = page().input.newest().steering;
    Vec2& way = turns ? steering.turn : steering.slide;
    way = {way.x + x, way.y + y};
}
EMSCRIPTEN_KEEPALIVE void theatron_wheel(double clicks) {
    if (std::isfinite(clicks))
        page().input.newest().steering.approach += clicks;
}
// The canvas has lost its content.
EMSCRIPTEN_KEEPALIVE void theatron_redraw() {
    page().input.newest().redraw = true;
}

// Memory that the script fills for the next function.
EMSCRIPTEN_KEEPALIVE void* theatron_memory(int size) {
    page().bytes.resize(std::size_t(size));
    return page().bytes.data();
}

}  // extern "C"

int main() {
    return 0;
}
