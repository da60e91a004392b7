// SPDX-License-Identifier: Apache-2.0
#include "viewer/trust_panel.h"

#include <algorithm>
#include <cstdio>

#include "viewer/age_text.h"
#include "wire/condition_text.h"

namespace theatron::viewer {
namespace {

bool is_live(const client::CameraFigures& camera) {
    return camera.camera.state.condition == wire::CameraCondition::live && !camera.depth.past;
}

bool is_played(const client::CameraFigures& camera) {
    return camera.played != client::CameraFigures::Played::no && is_live(camera);
}

// The older one of depth and colour counts.
double age_ms(const client::CameraFigures& camera) {
    return std::max(camera.depth.age_now_ms, camera.color.frames > 0 ? camera.color.age_now_ms : 0);
}

std::string rates(const client::CameraFigures& camera) {
    char text[100];
    std::snprintf(text, sizeof(text), "%.0f fps, %.1f Mbit/s, %llu lost on the way",
                  camera.depth.frames_per_second, camera.mbit_per_second(),
                  static_cast<unsigned long long>(camera.dropped()));
    return text;
}

}  // namespace

std::string exactness_text(const client::CameraFigures& camera) {
    if (camera.depth.frames == 0)
        return "";
    switch (camera.depth.exact) {
        case receive::Exactness::everywhere:
            return camera.camera.state.filter.empty() ? "lossless" : "lossless after filters";
        case receive::Exactness::region:
            return "lossless in the region of interest only";
        case receive::Exactness::nowhere:
            return "lossy";
    }
    return "";
}

xr::Panel trust_panel(const client::ParticipantFigures& figures,
                      const std::function<std::string(const std::string&)>& filter_name) {
    xr::Panel panel{"Cameras", {}};
    for (const client::CameraFigures& camera : figures.cameras) {
        const wire::CameraState& state = camera.camera.state;
        xr::PanelRow row{camera.camera.description.name, "", {}};
        if (camera.depth.frames == 0) {
            row.text += ": no picture yet";
        } else {
            row.text += is_played(camera) ? std::string(": NOT LIVE, ") + client::state_text(camera)
                                          : ": " + seen_age(age_ms(camera), is_live(camera));
            row.detail = rates(camera) + "\n" + "depth " + camera.depth.codec + ", " +
                         exactness_text(camera) + "; filters: " + filter_name(state.filter);
            if (!camera.color.codec.empty())
                row.detail += "\ncolour " + camera.color.codec;
        }
        if (const std::string text = client::adjustment_text(camera.camera.description);
            !text.empty())
            row.detail += (row.detail.empty() ? "" : "\n") + ("by operators: " + text);
        if (!state.problem.empty())
            row.detail += (row.detail.empty() ? "" : "\n") +
                          client::problem_text(state, figures.status.standing.role);
        panel.rows.push_back(std::move(row));
    }
    if (panel.rows.empty())
        panel.rows.push_back({"There are no cameras", "", {}});
    return panel;
}

std::string not_live_text(const client::ParticipantFigures& figures) {
    std::string text;
    for (const client::CameraFigures& camera : figures.cameras)
        if (!is_live(camera) && camera.depth.frames > 0)
            text += (text.empty() ? "Camera " : "; camera ") + camera.camera.description.name +
                    " is " + seen_age(age_ms(camera), false);
    return text;
}

}  // namespace theatron::viewer
