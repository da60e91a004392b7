// SPDX-License-Identifier: Apache-2.0
#include "or_screen/camera_choice.h"

#include <algorithm>
#include <cmath>

#include "or_screen/picture_place.h"

namespace theatron::or_screen {
namespace {

constexpr double unmeasured_weight = 0.2, edge_weight = 0.3;

// 1 in the picture's middle, edge_weight at its edges.
double weight_at(Vec2 pixel, Size size) {
    const double x = std::abs(2 * (pixel.x + 0.5) / size.width - 1);
    const double y = std::abs(2 * (pixel.y + 0.5) / size.height - 1);
    return 1 - (1 - edge_weight) * std::clamp(std::max(x, y), 0.0, 1.0);
}

bool is_better(const CameraScore& a, const CameraScore& b) {
    return a.is_live != b.is_live ? a.is_live : a.score > b.score;
}

}  // namespace

double score_of(const Calibration& calibration, DepthView depth, const std::vector<Vec3>& places) {
    double sum = 0;
    for (const Vec3& place : places) {
        const PicturePlace seen = place_in_picture(calibration, depth, place);
        if (seen.sight == Sight::outside || seen.sight == Sight::hidden)
            continue;
        const Vec3 in_color =
            calibration.color_from_depth * (inverse(calibration.room_from_camera) * place);
        const double pixels_per_mm = calibration.color.fx / in_color.z / 1000;
        sum += pixels_per_mm * weight_at(seen.pixel, calibration.color.size) *
               (seen.sight == Sight::visible ? 1 : unmeasured_weight);
    }
    return places.empty() ? 0 : sum / double(places.size());
}

void CameraChoice::show(CameraId camera, TimePoint now) {
    shown_ = camera;
    shown_since_ = now;
    rival_.reset();
}

std::optional<CameraId> CameraChoice::choose(const std::vector<CameraScore>& cameras,
                                             TimePoint now) {
    // The first one of equal ones.
    const auto best = std::min_element(cameras.begin(), cameras.end(), is_better);
    if (best == cameras.end()) {
        shown_.reset();
        return std::nullopt;
    }
    const auto shown = std::find_if(cameras.begin(), cameras.end(), [&](const CameraScore& one) {
        return shown_ && one.camera == *shown_;
    });
    if (shown == cameras.end() || (best->is_live && !shown->is_live)) {
        show(best->camera, now);
        return shown_;
    }
    if (best->camera == shown->camera || best->score <= much_better * shown->score) {
        rival_.reset();
        return shown_;
    }
    if (!rival_ || rival_->camera != best->camera)
        rival_ = Rival{best->camera, now};
    const int part = shown->score > 0 ? 1 : 2;
    if (now - rival_->since >= better_for / part && now - shown_since_ >= shown_for / part)
        show(best->camera, now);
    return shown_;
}

}  // namespace theatron::or_screen
