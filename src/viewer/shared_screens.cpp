// SPDX-License-Identifier: Apache-2.0
#include "viewer/shared_screens.h"

#include <algorithm>
#include <utility>

#include "pace/drawing_watch.h"
#include "phrases/phrase.h"
#include "room/people.h"
#include "viewer/age_text.h"
#include "wire/condition_text.h"

namespace theatron::viewer {
namespace {

// In widths of the screen. The caption stands above the picture, before the housing.
constexpr double rim = 0.017, thickness = 0.025, caption_height = 1 / 30.0, lifted = 0.003;
constexpr double faint_light = 0.15;  // of a picture that stands still
constexpr Rgb ink{235, 240, 245}, warning{255, 170, 60};

}  // namespace

ScreenCaption screen_caption(const std::string& name, const wire::CameraState& state,
                             std::optional<double> age_ms, bool is_past) {
    using Condition = wire::CameraCondition;
    if (is_past && age_ms)
        return {name + "  " + seen_age(*age_ms, false), true};
    if (state.condition == Condition::ended)
        return {say(Phrase::screen_ended, name), true};
    if (state.condition == Condition::failed)
        return {say(Phrase::screen_failed, name), true};
    if (!age_ms)
        return {say(Phrase::screen_waits, name), true};
    if (state.condition == Condition::stale || *age_ms >= old_picture_ms)
        return {say(Phrase::screen_stands_still, name, age_text(*age_ms)), true};
    return {name + "  " + age_text(*age_ms), false};
}

void SharedScreens::set_camera(CameraId camera, const std::string& name,
                               const Calibration& calibration) {
    Screen& screen = screens_[camera];
    if (screen.name == name && screen.calibration == calibration)
        return;
    // Only the place is another one.
    if (screen.name == name && screen.calibration.color.size == calibration.color.size) {
        screen.calibration = calibration;
        return;
    }
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
    screen.is_past = frame.past;
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
        ScreenCaption caption =
            screen_caption(screen.name, one.camera.state, age_ms, screen.is_past);
        const bool is_marked = screen.is_past || one.played != client::CameraFigures::Played::no;
        const bool is_faint = age_ms && !is_marked &&
                              (one.camera.state.condition != wire::CameraCondition::live ||
                               *age_ms >= to_ms(pace::still_after));
        changed = changed || caption != screen.caption || is_faint != screen.is_faint;
        screen.is_faint = is_faint;
        screen.caption = std::move(caption);
    }
    return changed;
}

bool SharedScreens::follow(const session::RoomObjects& objects, ParticipantId self) {
    bool changed = false;
    const auto object_of = [&](session::ObjectId id) {
        const session::RoomObject& object = objects.at(id);
        const auto facts = session::decode_shared_screen(object.kind, object.properties);
        return Object{id, session::place_of(object, *facts), facts->pinned, object.grip.holder};
    };
    const auto set = [&](Screen& screen, const std::optional<Object>& object) {
        changed = changed || object != screen.object;
        screen.object = object;
    };
    for (auto& [camera, screen] : screens_) {
        const auto id = session::find_screen(objects, camera, screen.name);
        set(screen, id ? std::optional(object_of(*id)) : std::nullopt);
    }
    std::map<CameraId, Screen> before = std::exchange(own_, {});
    for (const auto& [id, object] : objects) {
        const auto facts = session::decode_shared_screen(object.kind, object.properties);
        if (!facts || !facts->camera || session::is_recorded(id) || object.creator != self ||
            screens_.contains(*facts->camera))
            continue;
        Screen& own = own_[*facts->camera];
        if (auto known = before.find(*facts->camera); known != before.end())
            own = std::move(known->second);
        own.name = facts->name;
        own.calibration.color.size = facts->picture;
        own.caption = {say(Phrase::screen_is_own, facts->name), false};
        set(own, object_of(id));
    }
    return changed || before.size() != own_.size();
}

void SharedScreens::add_to(render::SceneFrame& frame) {
    for (auto* screens : {&screens_, &own_})
        for (auto& [camera, screen] : *screens)
            add(screen, frame);
}

void SharedScreens::add(Screen& screen, render::SceneFrame& frame) {
    const ScreenPlace place =
        screen.object ? screen.object->place : screen_place(screen.calibration);
    const double width = place.width_m;
    const double x = 0.5, y = 0.5 * place.height_m / width;
    if (!screen.panel) {
        screen.panel.emplace(render::make_panel_mesh(2 * x, 2 * y));
        screen.housing.emplace(
            render::make_box_mesh({-x - rim, -y - rim - 2 * caption_height, lifted},
                                  {x + rim, y + rim, lifted + thickness}));
    }
    if (screen.color && !screen.texture)
        screen.texture.emplace(screen.calibration.color.size);
    if (std::exchange(screen.is_new, false))
        screen.texture->set(screen.color->view());
    const auto id =
        screen.object ? render::PickId(std::uint32_t(screen.object->id)) : render::PickId::none;
    render::SurfaceLook look;
    const double light = !screen.color ? 0 : screen.is_faint ? faint_light : 1;
    look.base_color = {light, light, light};
    look.texture = screen.texture ? &*screen.texture : nullptr;
    look.unlit = true;
    render::SceneObject panel{&*screen.panel, place.room_from_screen, look, false, id, width};
    panel.casts_shadow = false;
    frame.objects.push_back(panel);
    const bool is_held = screen.object && screen.object->holder != ParticipantId{};
    const Vec3 color = is_held ? room::color_of(screen.object->holder) : Vec3{0.05, 0.06, 0.07};
    frame.objects.push_back(
        {&*screen.housing, place.room_from_screen, {color, 0, 0.6}, false, id, width});
    const Vec3 caption = Vec3{-x, -y - 0.7 * caption_height, -lifted} * width;
    frame.texts.push_back(
        {screen.caption.text +
             (screen.object && screen.object->pinned ? "  " + say(Phrase::pinned) : ""),
         place.room_from_screen * Pose{Quat{}, caption}, caption_height * width,
         screen.caption.is_trouble ? warning : ink});
}

}  // namespace theatron::viewer
