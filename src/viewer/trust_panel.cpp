// SPDX-License-Identifier: Apache-2.0
#include "viewer/trust_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "phrases/phrase.h"
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
    return std::max(camera.depth.age_now_ms, camera.color.has_come ? camera.color.age_now_ms : 0);
}

std::string rates(const client::CameraFigures& camera) {
    char mbit[32];
    std::snprintf(mbit, sizeof(mbit), "%.1f", camera.mbit_per_second());
    return say(Phrase::rates, std::to_string(std::lround(camera.depth.frames_per_second)),
               decimal(mbit), std::to_string(camera.dropped()));
}

}  // namespace

std::string exactness_text(const client::CameraFigures& camera) {
    if (!camera.depth.has_come)
        return "";
    switch (camera.depth.exact) {
        case receive::Exactness::everywhere:
            return say(camera.camera.state.filter.empty() ? Phrase::lossless
                                                          : Phrase::lossless_after_filters);
        case receive::Exactness::region:
            return say(Phrase::lossless_in_region);
        case receive::Exactness::nowhere:
            return say(Phrase::lossy);
    }
    return "";
}

window::Panel trust_panel(const client::ParticipantFigures& figures,
                          const std::function<std::string(const std::string&)>& filter_name) {
    window::Panel panel{say(Phrase::cameras), {}};
    for (const client::CameraFigures& camera : figures.cameras) {
        const wire::CameraState& state = camera.camera.state;
        window::PanelRow row{camera.camera.description.name, "", {}};
        if (!camera.depth.has_come) {
            row.text = say(Phrase::row_waits, row.text);
        } else {
            row.text =
                say(Phrase::row_is, row.text,
                    is_played(camera) ? say(camera.played == client::CameraFigures::Played::paused
                                                ? Phrase::row_paused
                                                : Phrase::row_recording)
                                      : seen_age(age_ms(camera), is_live(camera)));
            row.detail = rates(camera) + "\n" +
                         say(Phrase::depth_and_filters, camera.depth.codec, exactness_text(camera),
                             filter_name(state.filter));
            if (!camera.color.codec.empty())
                row.detail += "\n" + say(Phrase::color_codec, camera.color.codec);
        }
        if (const std::string text = client::adjustment_text(camera.camera.description);
            !text.empty())
            row.detail += (row.detail.empty() ? "" : "\n") + say(Phrase::by_operators, text);
        if (!state.problem.empty())
            row.detail += (row.detail.empty() ? "" : "\n") +
                          client::problem_text(state, figures.status.standing.role);
        panel.rows.push_back(std::move(row));
    }
    if (panel.rows.empty())
        panel.rows.push_back({say(Phrase::no_cameras), "", {}});
    return panel;
}

std::string not_live_text(const client::ParticipantFigures& figures) {
    std::string text;
    for (const client::CameraFigures& camera : figures.cameras)
        if (!is_live(camera) && camera.depth.has_come)
            text += say(text.empty() ? Phrase::camera_is : Phrase::camera_is_also,
                        camera.camera.description.name, seen_age(age_ms(camera), false));
    return text;
}

}  // namespace theatron::viewer
