// SPDX-License-Identifier: Apache-2.0
#include "viewer/shared_screens.h"

#include <algorithm>
#include <utility>

#include "viewer/age_text.h"
#include "wire/condition_text.h"

namespace theatron::viewer {
namespace {

constexpr double rim_m = 0.02, thickness_m = 0.03;
// The caption stands above the picture, before the housing.
constexpr double captions_in_width = 30, before_m = 0.003;
constexpr Rgb ink{235, 240, 245}, warning{255, 170, 60};

}  // namespace

ScreenCaption screen_caption(const std::string& name, const wire::CameraState& state,
                             std::optional<double> age_ms) {
    using Condition = wire::CameraCondition;
    if (state.condition == Condition::ended)
        return {name + ": has ended, this is its last picture", true};
    if (state.condition == Condition::failed)
        return {name + ": has failed", true};
    if (!age_ms)
        return {name + ": no picture yet", true};
    if (state.condition == Condition::stale || *age_ms >= old_picture_ms)
        return {name + ": stands still for " + age_text(*age_ms), true};
    return {name + "  " + age_text(*age_ms), false};
}

void SharedScreens::set_camera(CameraId camera, const std::string& name,
                               const Calibration& calibration) {
    Screen& screen = screens_[camera];
    if (screen.name == name && screen.calibration == calibration)
        return;
    screen = {};
    screen.name = name;
    screen.calibration = calibration;
    screen.caption = screen_caption(name, {}, std::nullopt);
}

void SharedScreens::take(const receive::CameraFrame& frame) {
    const auto found = screens_.find(frame.camera);
    if (found == screens_.end() || !frame.color)
        return;
    Screen& screen = found->second;
    // The same picture may come with a newer frame: it is as old as before.
    if (frame.color == screen.color || frame.color->size != screen.calibration.color.size)
        return;
    screen.color = frame.color;
    screen.captured = frame.times.captured;
    screen.is_new = true;
}

bool SharedScreens::note(const std::vector<client::CameraFigures>& cameras, TimePoint now) {
    bool changed = false;
    for (const client::CameraFigures& one : cameras) {
        const auto found = screens_.find(one.camera.description.id);
        if (found == screens_.end())
            continue;
        Screen& screen = found->second;
        std::optional<double> age_ms;
        if (screen.color)
            age_ms = std::max(0.0, to_ms(now - screen.captured));
        ScreenCaption caption = screen_caption(screen.name, one.camera.state, age_ms);
        changed = changed || caption != screen.caption;
        screen.caption = std::move(caption);
    }
    return changed;
}

void SharedScreens::add_to(render::SceneFrame& frame) {
    for (auto& [id, screen] : screens_) {
        const ScreenPlace place = screen_place(screen.calibration);
        const double caption_m = place.width_m / captions_in_width;
        const double x = place.width_m / 2, y = place.height_m / 2;
        if (!screen.panel) {
            screen.texture.emplace(screen.calibration.color.size);
            screen.panel.emplace(render::make_panel_mesh(place.width_m, place.height_m));
            screen.housing.emplace(
                render::make_box_mesh({-x - rim_m, -y - rim_m - 2 * caption_m, before_m},
                                      {x + rim_m, y + rim_m, before_m + thickness_m}));
        }
        if (std::exchange(screen.is_new, false))
            screen.texture->set(screen.color->view());
        render::SurfaceLook look;
        look.base_color = screen.color ? Vec3{1, 1, 1} : Vec3{0, 0, 0};
        look.texture = &*screen.texture;
        look.unlit = true;
        render::SceneObject panel{&*screen.panel, place.room_from_screen, look};
        panel.casts_shadow = false;
        frame.objects.push_back(panel);
        frame.objects.push_back(
            {&*screen.housing, place.room_from_screen, {{0.05, 0.06, 0.07}, 0, 0.6}});
        frame.texts.push_back(
            {screen.caption.text,
             place.room_from_screen * Pose{Quat{}, {-x, -y - 0.7 * caption_m, -before_m}},
             caption_m, screen.caption.is_trouble ? warning : ink});
    }
}

}  // namespace theatron::viewer
