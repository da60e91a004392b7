// SPDX-License-Identifier: Apache-2.0
#include "compare_shown.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "camera_frames.h"
#include "compare_close_up.h"
#include "compare_drawing_times.h"
#include "compare_points.h"
#include "render/cloud_set.h"
#include "render/gl_driver.h"

namespace theatron::bench {
namespace {

// The last depth images of the cameras, beside what arrived of them.
std::vector<CauseCamera> causes_with(const std::vector<const CompareCamera*>& cameras,
                                     const std::vector<ArrivedCamera>& arrived) {
    std::vector<CauseCamera> causes;
    for (std::size_t c = 0; c < cameras.size(); ++c)
        causes.push_back({cameras[c]->calibration, cameras[c]->depth.back().view(),
                          arrived[c].depth.back().view()});
    return causes;
}

}  // namespace

ColorImage beside_each_other(const std::vector<ColorImage>& pictures) {
    Size size;
    for (const ColorImage& picture : pictures) {
        size.width += picture.size.width;
        size.height = std::max(size.height, picture.size.height);
    }
    ColorImage all(size);
    int left = 0;
    for (const ColorImage& picture : pictures) {
        for (int y = 0; y < picture.size.height; ++y)
            std::copy_n(picture.view().row(y), picture.size.width, all.view().row(y) + left);
        left += picture.size.width;
    }
    return all;
}

void show_video(CompareMethod& method, const std::vector<const CompareCamera*>& cameras,
                const std::vector<ArrivedCamera>& arrived, Vec3 point_room, bool is_zoomed) {
    std::vector<ColorImage> pictures, parts;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        pictures.push_back(arrived[c].color.back());
        const auto part = part_around(cameras[c]->calibration, pictures.back().size, point_room,
                                      close_up_width_m);
        if (is_zoomed)
            parts.push_back(pictures.back());
        else if (part)
            parts.push_back(parts_of<Rgb>({pictures.back()}, *part).front());
    }
    if (!is_zoomed)
        method.pictures = {std::move(pictures.back())};
    if (!parts.empty())
        method.close_up = {beside_each_other(parts), {}, {}, {}};
}

std::vector<SightCamera> sight_cameras(const std::vector<const CompareCamera*>& cameras,
                                       const std::vector<ArrivedCamera>& arrived,
                                       bool is_in_depth_raster) {
    std::vector<SightCamera> sights;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const Calibration& calibration = cameras[c]->calibration;
        sights.push_back(
            {.lens = calibration.color,
             .room_from_lens = calibration.room_from_camera * inverse(calibration.color_from_depth),
             .exact_m = cameras[c]->last_exact_m.view(),
             .coarsest_mm_at_1m = is_in_depth_raster ? 1000 / calibration.depth.fx : 0,
             .grid_mm = arrived[c].point_grid_m * 1000});
    }
    return sights;
}

CompareDrawing::CompareDrawing() {
    try {
        context_ = std::make_unique<render::OffscreenContext>();
        driver_ = render::driver_name();
    } catch (const Error& e) {
        reason_ = e.what();
    }
}

void CompareDrawing::check() const {
    if (context_ && context_->errors() > 0)
        throw Error("The graphics driver reports an error: " + context_->first_error());
}

void CompareDrawing::time_video(CompareMethod& method, const std::vector<ArrivedCamera>& arrived,
                                Size size) const {
    if (!context_)
        return;
    method.drawing_ms = drawing_ms_of_video(arrived, size);
    method.drawn_on = driver_;
}

void CompareDrawing::show_clouds(CompareMethod& method, const CompareViews& exact,
                                 const std::vector<const CompareCamera*>& cameras,
                                 const std::vector<ArrivedCamera>& arrived, Image<float> details,
                                 const std::string& renderer,
                                 const std::function<void(double)>& progress) const {
    if (!context_) {
        method.expert_reason = reason_;
        return;
    }
    const auto draw = [&](render::CloudSet& clouds, const ViewBenchPlace& place) {
        return clouds.render(place.view, place.exact_color.size, renderer);
    };
    render::CloudSet clouds;
    for (std::size_t c = 0; c < arrived.size(); ++c)
        clouds.set_camera(CameraId(c), arrived[c].calibration);
    const std::size_t images = arrived.front().depth.size();
    const double all = double(images + exact.places.size());
    for (std::size_t i = 0; i < images; ++i) {
        for (std::size_t c = 0; c < arrived.size(); ++c)
            if (clouds.upload(CameraId(c), arrived[c].depth[i].view(),
                              arrived[c].color[i].view()) != Status::ok)
                throw Error("A generated camera's images do not have its calibrated size.");
        if (i + 1 < images)
            (void)draw(clouds, exact.places.front());
        progress(double(i + 1) / all);
    }
    DrawnViews drawn;
    for (const ViewBenchPlace& place : exact.places) {
        drawn.places.push_back(draw(clouds, place));
        progress(double(images + drawn.places.size()) / all);
    }
    drawn.close_up = draw(clouds, exact.close_up);
    judge(method, exact, std::move(drawn), causes_with(cameras, arrived), std::move(details));
    const ViewBenchPlace& first = exact.places.front();
    method.drawing_ms =
        drawing_ms_of_clouds(clouds, arrived, first.view, first.exact_color.size, renderer);
    method.drawn_on = driver_;
}

void show_points(CompareMethod& method, const CompareViews& exact,
                 const std::vector<const CompareCamera*>& cameras,
                 const std::vector<ArrivedCamera>& arrived, Image<float> details) {
    std::vector<PlacedCloud> placed;
    for (const ArrivedCamera& camera : arrived)
        placed.push_back({&camera.points, camera.calibration.room_from_camera});
    const auto draw = [&](const ViewBenchPlace& place) {
        return draw_points(placed, place.view, place.exact_color.size,
                           arrived.front().point_edge_m);
    };
    DrawnViews drawn;
    for (const ViewBenchPlace& place : exact.places)
        drawn.places.push_back(draw(place));
    drawn.close_up = draw(exact.close_up);
    judge(method, exact, std::move(drawn), causes_with(cameras, arrived), std::move(details));
    method.drawing_ms = drawing_ms_of([&] { (void)draw(exact.places.front()); });
    method.drawn_on = "the processor";
}

}  // namespace theatron::bench
