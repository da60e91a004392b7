// SPDX-License-Identifier: Apache-2.0
#include "viewer/screen_handling.h"

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

void ScreenHandling::send(client::Participant& participant, TimePoint now) {
    if (!waiting_ || now - sent_ < send_interval)
        return;
    set_screen(participant, *waiting_);
    waiting_.reset();
    sent_ = now;
}

void ScreenHandling::on_input(xr::WindowInput& input, std::optional<double> surface_m,
                              double aspect, const render::CameraView& view, Meeting& meeting,
                              client::Participant& participant, TimePoint now) {
    const CaseScene& scene = meeting.case_scene();
    const auto& open = scene.in_room();
    const medical::Volume* volume = scene.monitor().volume();
    if (!open || !open->screen || (!volume && scene.monitor().pictures() == 0)) {
        drags_window_ = false;
        waiting_.reset();
        return;
    }
    const auto picks_picture = [&](Vec2 pointer) {
        const auto hit = meeting.pick(render::ray_through(view, pointer), view);
        return hit && hit->object == open->screen->id &&
               scene.monitor().shows_at(*open, hit->picked.place) &&
               !is_hidden(hit->picked.place, surface_m, view);
    };
    session::CaseScreen next = waiting_.value_or(open->screen->facts);
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
        waiting_ = next;
    send(participant, now);
}

}  // namespace theatron::viewer
