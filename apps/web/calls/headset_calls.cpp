// SPDX-License-Identifier: Apache-2.0
// The functions that page/page.js and page/headset.js call for a headset.
#include <emscripten/emscripten.h>

#include "base/steady_clock.h"
#include "headset_input.h"
#include "visit.h"

using namespace theatron;
using theatron::web::page;

extern "C" {

// Until theatron_leave_headset() the page draws for a headset, whose display shows this number of
// pictures a second.
EMSCRIPTEN_KEEPALIVE void theatron_enter_headset(int real_room, double pictures_per_s) {
    if (page().visit)
        web::guarded([&] {
            page().visit->viewer.enter_headset(real_room != 0, pictures_per_s, steady_now());
        });
}
// Numbers as in headset_input.h, in theatron_memory().
EMSCRIPTEN_KEEPALIVE void theatron_draw_headset(int real_room) {
    const auto frame = web::read_headset_frame(page().bytes);
    if (page().visit && page().visit->viewer.has_headset() && frame)
        web::guarded([&] { web::draw_headset(*page().visit, *frame, real_room != 0); });
}
// The share of the layer's pixels on each side that the client can draw at the display's rate.
EMSCRIPTEN_KEEPALIVE double theatron_headset_scale() {
    return page().visit ? page().visit->viewer.way().scale : 1;
}
// The tracking space was moved, before the first frame that is in the new one. `is_known`:
// theatron_memory() has a pose, as headset_input.h writes it, of the new origin in the old space.
EMSCRIPTEN_KEEPALIVE void theatron_space_moved(int is_known) {
    const auto moved = is_known != 0 ? web::read_headset_pose(page().bytes) : std::nullopt;
    if (page().visit)
        web::guarded([&] { page().visit->viewer.on_headset_space_moved(moved); });
}
// The person's choice in the headset's menu since the last call: 1: the microphone, 2: to leave
// the headset, 0: nothing.
EMSCRIPTEN_KEEPALIVE int theatron_headset_wish(int microphone_open) {
    if (!page().visit)
        return 0;
    page().visit->viewer.set_microphone_open(microphone_open != 0);
    const auto wish = page().visit->viewer.take_headset_wish();
    return !wish ? 0 : *wish == viewer::MenuAction::microphone ? 1 : 2;
}
EMSCRIPTEN_KEEPALIVE void theatron_leave_headset() {
    if (page().visit)
        web::guarded([] { page().visit->viewer.leave_headset(); });
}

}  // extern "C"
