// SPDX-License-Identifier: Apache-2.0
#include "viewer/still_cover.h"

#include <algorithm>

#include "geometry/screen.h"
#include "pace/drawing_watch.h"
#include "phrases/phrase.h"
#include "viewer/age_text.h"

namespace theatron::viewer {

bool stands_still(const ShownCamera& camera, TimePoint now) {
    return !camera.is_exempt && camera.newest && now - *camera.newest >= pace::still_after;
}

std::optional<Duration> all_still(const std::vector<ShownCamera>& cameras, TimePoint now) {
    std::optional<Duration> age;
    for (const ShownCamera& camera : cameras) {
        if (!camera.newest)
            continue;
        if (!stands_still(camera, now))
            return std::nullopt;
        age = std::min(age.value_or(Duration::max()), now - *camera.newest);
    }
    return age;
}

ShownCamera shown_camera(const client::CameraFigures& camera, TimePoint now) {
    const receive::StreamFigures* const seen = camera.seen();
    ShownCamera shown;
    shown.is_exempt = !seen || seen->past || camera.played != client::CameraFigures::Played::no;
    // Until the session's clock is known the figures have ages of 0.
    if (seen && seen->has_come)
        shown.newest = now - seconds_to_duration(seen->age_now_ms / 1000);
    return shown;
}

std::vector<ShownCamera> shown_cameras(const std::vector<client::CameraFigures>& cameras,
                                       TimePoint now) {
    std::vector<ShownCamera> shown;
    for (const client::CameraFigures& camera : cameras)
        if (camera.camera.description.kind == wire::CameraKind::room &&
            camera.camera.calibration.person == 0 && !is_screen(camera.camera.calibration))
            shown.push_back(shown_camera(camera, now));
    return shown;
}

std::string still_text(std::optional<Duration> still) {
    return still ? say(Phrase::no_picture_for, age_text(to_ms(*still))) : "";
}

}  // namespace theatron::viewer
