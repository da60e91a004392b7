// SPDX-License-Identifier: Apache-2.0
#include "compare_causes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/image.h"
#include "render/picture_quality.h"

namespace theatron::bench {
namespace {

// Where a surface is lost, in the order of the steps; the last one of all cameras counts.
enum Step : std::uint8_t { camera, sensor, filters, drawing, step_count };

// True if one of the four pixels around the point's place measures something within jump_mm of it.
bool has_point(DepthView depth, double unit_mm, Vec2 place, double z_mm, int jump_mm) {
    const int x0 = int(std::floor(place.x)), y0 = int(std::floor(place.y));
    for (int y = std::max(y0, 0); y <= std::min(y0 + 1, depth.size.height - 1); ++y)
        for (int x = std::max(x0, 0); x <= std::min(x0 + 1, depth.size.width - 1); ++x) {
            const double mm = depth.row(y)[x] * unit_mm;
            if (mm > 0 && std::abs(mm - z_mm) <= jump_mm)
                return true;
        }
    return false;
}

Step step_of(const CauseCamera& camera, Vec3 point_room, int jump_mm) {
    const Calibration& c = camera.calibration;
    const Vec3 p = inverse(c.room_from_camera) * point_room;
    const auto place = project(c.depth, p);
    if (!place || !has_point(camera.measured, c.depth_unit_mm, *place, p.z * 1000, jump_mm))
        return Step::sensor;
    return has_point(camera.arrived, c.depth_unit_mm, *place, p.z * 1000, jump_mm) ? Step::drawing
                                                                                   : Step::filters;
}

// The step that loses each judged surface, if one does.
Image<std::uint8_t> lost_by(const CauseInput& input, const std::vector<CauseCamera>& cameras) {
    const Size size = input.exact_mm.size;
    Image<std::uint8_t> steps(size);
    const render::CameraView& view = input.view;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int mm = input.exact_mm.row(y)[x];
            if (!input.where.row(y)[x] || mm == 0)
                continue;
            const double z = mm / 1000.0;
            const Vec3 point =
                view.room_from_eye *
                Vec3{(view.left + (view.right - view.left) * (x + 0.5) / size.width) * z,
                     (view.top + (view.bottom - view.top) * (y + 0.5) / size.height) * z, z};
            Step step = input.seen.row(y)[x] ? Step::sensor : Step::camera;
            if (step != Step::camera)
                for (const CauseCamera& c : cameras)
                    step = std::max(step, step_of(c, point, input.jump_mm));
            steps.view().row(y)[x] = step;
        }
    return steps;
}

}  // namespace

CompareCauses causes_of(const CauseInput& input, const std::vector<CauseCamera>& cameras,
                        const CompareSights& sights) {
    const Image<std::uint8_t> steps = lost_by(input, cameras);
    std::array<double, step_count> lost{};
    double all = 0;
    for (int y = 0; y < steps.size.height; ++y)
        for (int x = 0; x < steps.size.width; ++x) {
            const Seen seen = sights.seen.view().row(y)[x];
            if (!input.where.row(y)[x] || seen == Seen::nothing_there)
                continue;
            ++all;
            if (seen != Seen::rightly)
                ++lost[steps.view().row(y)[x]];
        }
    const double percent = all > 0 ? 100 / all : 0;
    return {lost[Step::camera] * percent, lost[Step::sensor] * percent,
            lost[Step::filters] * percent, lost[Step::drawing] * percent};
}

CompareCauses causes_of(const CauseInput& input, const std::vector<CauseCamera>& cameras) {
    const Image<std::uint8_t> steps = lost_by(input, cameras);
    std::array<Image<std::uint8_t>, step_count> lost;
    for (Image<std::uint8_t>& mask : lost)
        mask.resize(steps.size);
    for (int y = 0; y < steps.size.height; ++y)
        for (int x = 0; x < steps.size.width; ++x)
            if (input.where.row(y)[x] && input.exact_mm.row(y)[x] > 0)
                lost[steps.view().row(y)[x]].view().row(y)[x] = 1;
    render::Holes all(input.jump_mm);
    all.add(input.drawn_mm, input.exact_mm, input.where);
    std::array<double, step_count> percent{};
    for (int step = 0; step < step_count; ++step) {
        render::Holes one(input.jump_mm);
        one.add(input.drawn_mm, input.exact_mm, std::as_const(lost[std::size_t(step)]).view());
        if (all.missing_pixels() > 0)
            percent[std::size_t(step)] =
                all.percent() * one.missing_pixels() / all.missing_pixels();
    }
    return {percent[Step::camera], percent[Step::sensor], percent[Step::filters],
            percent[Step::drawing]};
}

}  // namespace theatron::bench
