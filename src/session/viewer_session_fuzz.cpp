// SPDX-License-Identifier: Apache-2.0
// A hostile host: any control messages (each behind a two-byte length). The viewer's state stays
// within its limits, and its texts and calibrations can be shown and used.
#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/outside_text.h"
#include "geometry/calibration.h"
#include "session/announced_cameras.h"
#include "session/viewer_session.h"

namespace {

using namespace theatron;

bool is_shown_as_it_is(const std::string& text) {
    return clean_text(text, wire::max_filter) == text;
}

void check(const session::ViewerSession& viewer) {
    std::set<CameraId> known;
    std::size_t depth_pixels = 0, color_pixels = 0;
    for (const wire::Camera& camera : viewer.cameras()) {
        const auto calibration = decode_calibration(camera.calibration);
        if (!calibration || !known.insert(camera.id).second ||
            int(camera.id) > session::max_camera_number || !is_shown_as_it_is(camera.name))
            std::abort();
        depth_pixels += calibration->depth.size.area();
        color_pixels += calibration->color.size.area();
    }
    if (depth_pixels > session::max_total_depth_pixels ||
        color_pixels > session::max_total_color_pixels)
        std::abort();
    for (const auto& [camera, state] : viewer.camera_states())
        if (!known.contains(camera) || !is_shown_as_it_is(wire::english(state.problem)))
            std::abort();
    for (const std::string& text : {wire::english(viewer.note()), wire::english(viewer.refusal()),
                                    wire::sent_part(viewer.delivery()),
                                    viewer.renderer_command().renderer, viewer.welcome().host_name})
        if (!is_shown_as_it_is(text))
            std::abort();
    if (viewer.cameras().size() > wire::max_cameras || viewer.settings().size() > wire::max_streams)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    session::ViewerSession viewer({"secret", "someone"});
    ByteReader in(std::as_bytes(std::span(data, size)));
    while (!in.rest().empty()) {
        const auto what = in.get<std::uint8_t>();
        const std::size_t length = in.get<std::uint16_t>();
        (void)viewer.on_control(in.get_bytes(std::min(length, in.rest().size())));
        if (what < 8)
            (void)viewer.begin();
        check(viewer);
    }
    return 0;
}
