// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/slice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/case_actions.h"

namespace theatron::viewer {
namespace {

// In steps of the images' values.
constexpr double least_width = 1, most_width = 65'536, most_center = 65'536;

}  // namespace

bool is_hidden(Vec3 place, std::optional<double> surface_m, const render::CameraView& view) {
    // Marks stand out of the surface that they are on.
    constexpr double height_of_marks_m = 0.05;
    return surface_m && *surface_m + height_of_marks_m < (inverse(view.room_from_eye) * place).z;
}

session::CaseScreen scrolled(const session::CaseScreen& screen, const medical::Volume& volume,
                             double slices) {
    session::CaseScreen next = screen;
    const medical::SliceRange range =
        medical::slice_range(volume.grid, medical::Orientation(screen.orientation));
    next.position_mm =
        std::clamp(screen.position_mm + slices * range.step_mm, range.first_mm, range.last_mm);
    return next;
}

session::CaseScreen turned(const session::CaseScreen& screen, const medical::Volume& volume,
                           medical::Orientation orientation) {
    session::CaseScreen next = screen;
    next.picture.reset();
    next.orientation = std::uint8_t(orientation);
    const medical::SliceRange range = medical::slice_range(volume.grid, orientation);
    next.position_mm = range.first_mm + range.step_mm * (range.count / 2);
    return next;
}

session::CaseScreen through(const session::CaseScreen& screen, Vec3 patient_mm) {
    session::CaseScreen next = screen;
    next.picture.reset();
    switch (medical::Orientation(screen.orientation)) {
        case medical::Orientation::axial:
            next.position_mm = patient_mm.z;
            break;
        case medical::Orientation::coronal:
            next.position_mm = patient_mm.y;
            break;
        case medical::Orientation::sagittal:
            next.position_mm = patient_mm.x;
            break;
    }
    return next;
}

session::CaseScreen of_series(const session::CaseScreen& screen, int series,
                              const medical::Volume* volume) {
    session::CaseScreen next = screen;
    next.picture.reset();
    next.series = std::uint8_t(series);
    if (volume) {
        next.center = volume->window.center;
        next.width = volume->window.width;
        next = scrolled(next, *volume, 0);
    }
    return next;
}

session::CaseScreen stepped(const session::CaseScreen& screen, int count, double steps) {
    session::CaseScreen next = screen;
    const double to = screen.picture ? *screen.picture + steps : 0;
    next.picture = std::uint16_t(std::clamp(to, 0.0, count - 1.0));
    return next;
}

std::optional<SliceHit> slice_at(const render::PickRay& ray, const render::CameraView& view,
                                 Meeting& meeting) {
    const CaseScene& scene = meeting.case_scene();
    const auto& open = scene.in_room();
    const auto hit = meeting.pick(ray, view);
    if (!open || !open->screen || !hit)
        return std::nullopt;
    const session::CaseScreen& screen = open->screen->facts;
    const double distance_m = length(hit->picked.place - ray.from);
    if (hit->object == open->screen->id) {
        const auto on_slice = scene.monitor().patient_point(*open, hit->picked.place);
        if (!on_slice)
            return std::nullopt;
        session::CaseScreen next = screen;
        next.orientation =
            std::uint8_t((screen.orientation + 1) % session::CaseScreen::orientations);
        return SliceHit{through(next, *on_slice), {}, distance_m};
    }
    const auto place = scene.patient_point(hit->object, hit->picked.place);
    return place ? std::optional(SliceHit{through(screen, *place), hit->object, distance_m})
                 : std::nullopt;
}

void WantedScreen::send(client::Participant& participant, TimePoint now) {
    if (!waiting_ || now - sent_ < send_interval)
        return;
    set_screen(participant, *waiting_);
    waiting_.reset();
    sent_ = now;
}

bool SliceTool::on_pointer(const Pointer& pointer, const ToolScene& scene) {
    bool uses = held_.has_value();
    if (pointer.ray && pointer.presses)
        uses = begin(*pointer.ray, scene);
    else if (pointer.ray && held_)
        move(*pointer.ray, scene);
    if (pointer.releases)
        held_.reset();
    wanted_.send(scene.participant, scene.now);
    return uses;
}

bool SliceTool::begin(const render::PickRay& ray, const ToolScene& scene) {
    held_.reset();
    const auto& open = scene.meeting.case_scene().in_room();
    const auto hit = slice_at(ray, scene.view, scene.meeting);
    const auto cloud = pick_cloud(scene.cloud, ray);
    if (!hit || (cloud && cloud->distance_m < hit->distance_m)) {
        if (!cuts_ || !open || !open->organ.cut || scene.meeting.pick(ray, scene.view))
            return false;
        return cut_at_slice(scene.participant, false);
    }
    wanted_.want(hit->screen);
    if (cuts_ && !open->organ.cut)
        (void)cut_at_slice(scene.participant, true);
    held_ = hit;
    return true;
}

// The place of the organ that was met stays at its distance on the ray.
void SliceTool::move(const render::PickRay& ray, const ToolScene& scene) {
    const CaseScene& shown = scene.meeting.case_scene();
    const auto place =
        shown.patient_point(held_->part, ray.from + normalized(ray.direction) * held_->distance_m);
    if (!place || !shown.in_room()->screen)
        return;
    session::CaseScreen next = through(shown.in_room()->screen->facts, *place);
    if (const medical::Volume* volume = shown.monitor().volume())
        next = scrolled(next, *volume, 0);
    if (next != shown.in_room()->screen->facts)
        wanted_.want(next);
}

void ScreenHandling::on_input(window::WindowInput& input, std::optional<double> surface_m,
                              double aspect, const render::CameraView& view, Meeting& meeting,
                              client::Participant& participant, TimePoint now) {
    const CaseScene& scene = meeting.case_scene();
    const auto& open = scene.in_room();
    const medical::Volume* volume = scene.monitor().volume();
    if (!open || !open->screen || (!volume && scene.monitor().pictures() == 0)) {
        drags_window_ = false;
        wanted_.forget();
        return;
    }
    const auto picks_picture = [&](Vec2 pointer) {
        const auto hit = meeting.pick(render::ray_through(view, pointer), view);
        return hit && hit->object == open->screen->id &&
               scene.monitor().shows_at(*open, hit->picked.place) &&
               !is_hidden(hit->picked.place, surface_m, view);
    };
    session::CaseScreen next = wanted_.waiting().value_or(open->screen->facts);
    const session::CaseScreen before = next;
    if (input.grabbed && input.grabbed_left && !next.picture && picks_picture(*input.grabbed)) {
        drags_window_ = true;
        input.grabbed.reset();
    }
    if (drags_window_) {
        const double right = std::exchange(input.steering.turn.x, 0) / aspect,
                     down = std::exchange(input.steering.turn.y, 0);
        // Maps (diffusion, SUV) have values far below 1, activities far above.
        const double step = volume ? std::abs(volume->slope) : 1;
        next.width = std::clamp(next.width + right * units_per_picture * step, least_width * step,
                                most_width * step);
        next.center = std::clamp(next.center - down * units_per_picture * step, -most_center * step,
                                 most_center * step);
    }
    if (input.released)
        drags_window_ = false;
    if (input.steering.approach != 0 && input.pointer && picks_picture(*input.pointer)) {
        const double steps = std::round(std::exchange(input.steering.approach, 0));
        if (next.picture)
            next = stepped(next, std::max(scene.monitor().pictures(), 1), steps);
        else if (volume)
            next = scrolled(next, *volume, steps);
    }
    if (next != before)
        wanted_.want(next);
    wanted_.send(participant, now);
}

}  // namespace theatron::viewer
