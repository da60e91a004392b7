// SPDX-License-Identifier: Apache-2.0
#include "bench_render.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/statistics.h"
#include "geometry/camera_model.h"
#include "render/ball_scene.h"
#include "render/cloud_set.h"
#include "render/gl.h"
#include "render/offscreen_context_native.h"
#include "render/render_target.h"
#include "render/room_picture.h"

namespace theatron::bench {
namespace {

using render::CameraView;
using render::CloudSet;
using render::Picture;

constexpr Rgb black{};

// The colour of a point in the camera's own picture, if it is visible there.
std::optional<Rgb> color_of(const RenderBenchCamera& camera, Vec3 point) {
    if (camera.color.empty())
        return std::nullopt;
    const CameraModel lens = scaled(camera.calibration.color, camera.color.size);
    const auto pixel = project(lens, camera.calibration.color_from_depth * point);
    if (!pixel)
        return std::nullopt;
    const int x = int(std::lround(pixel->x)), y = int(std::lround(pixel->y));
    if (x < 0 || y < 0 || x >= lens.size.width || y >= lens.size.height)
        return std::nullopt;
    return camera.color.view().row(y)[x];
}

bool alike(Rgb a, std::optional<Rgb> b) {
    return !b || std::abs(a.r - b->r) + std::abs(a.g - b->g) + std::abs(a.b - b->b) < 30;
}

// True if the picture has this depth and colour within two pixels of `place`.
bool shown_near(const Picture& drawn, Vec2 place, double mm, std::optional<Rgb> color) {
    const Size size = drawn.color.size;
    const int x0 = int(std::lround(place.x)), y0 = int(std::lround(place.y));
    for (int y = std::max(0, y0 - 2); y <= std::min(size.height - 1, y0 + 2); ++y)
        for (int x = std::max(0, x0 - 2); x <= std::min(size.width - 1, x0 + 2); ++x)
            if (std::abs(drawn.depth_mm.view().row(y)[x] - mm) <= 5 &&
                alike(drawn.color.view().row(y)[x], color))
                return true;
    return false;
}

// Renders one camera from its own position and checks each of its pixels.
void check_renderer(const RenderBenchCamera& camera, const std::string& renderer) {
    CloudSet scene;
    scene.set_camera(CameraId{0}, camera.calibration);
    upload(scene, 0, camera);
    const CameraModel& lens = camera.calibration.depth;
    const CameraView view =
        render::view_of_camera(lens, camera.calibration.room_from_camera, lens.size);
    const Picture drawn = scene.render(view, lens.size, renderer);

    CameraModel eye;  // the camera's lens without distortion
    eye.size = lens.size;
    eye.fx = lens.fx;
    eye.fy = lens.fy;
    eye.cx = lens.cx;
    eye.cy = lens.cy;
    long valid = 0, shown = 0;
    for (int y = 0; y < lens.size.height; ++y)
        for (int x = 0; x < lens.size.width; ++x) {
            const double mm = camera.depth.view().row(y)[x] * camera.calibration.depth_unit_mm;
            const auto ray = unproject(lens, {double(x), double(y)});
            if (mm == 0 || !ray)
                continue;
            const Vec2 place = project(eye, {ray->x, ray->y, 1}).value();
            if (place.x < 0 || place.y < 0 || place.x > lens.size.width - 1 ||
                place.y > lens.size.height - 1)
                continue;
            ++valid;
            const double z = mm / 1000;
            shown += shown_near(drawn, place, mm, color_of(camera, {ray->x * z, ray->y * z, z}));
        }
    if (double(shown) < 0.95 * double(valid))
        throw Error("The renderer " + renderer + " shows only " + std::to_string(shown) + " of " +
                    std::to_string(valid) + " points of a camera in their places.");
}

// The clouds alone and in the room: a picture, and how long the room takes to be made.
nlohmann::json bench_rooms(const RenderBench& bench, const CameraView& view,
                           const render::RenderTarget& target, CloudSet& clouds) {
    struct Case {
        const char* name;
        std::optional<FurnishedRoom> room;
        std::vector<double> frame_ms, build_ms;
    };
    Case cases[3];
    cases[0].name = "clouds alone";
    cases[1].name = "room low";
    cases[1].room.emplace(render::SceneQuality::low, view);
    cases[2].name = "room high";
    cases[2].room.emplace(render::SceneQuality::high, view);
    render::ScenePasses passes;
    for (int round = 0; round <= bench.repetitions; ++round)
        for (Case& c : cases) {
            if (c.room && round <= 3) {
                c.room->forget();
                c.build_ms.push_back(gpu_ms([&] { (void)c.room->fill(); }));
            }
            const double ms = gpu_ms([&] {
                target.clear(black);
                render::draw({c.room ? &c.room->fill() : nullptr,
                              {{&clouds, "mesh"}},
                              {{view, target.target()}}},
                             &passes);
            });
            if (round > 0)
                c.frame_ms.push_back(ms);
        }
    nlohmann::json rows = nlohmann::json::array();
    for (const Case& c : cases)
        rows.push_back({{"name", c.name},
                        {"frame_ms", median(c.frame_ms)},
                        {"build_ms", c.build_ms.empty() ? 0.0 : median(c.build_ms)}});
    return rows;
}

}  // namespace

std::vector<RenderBenchCamera> generated_render_cameras(int count) {
    std::vector<RenderBenchCamera> cameras;
    for (int i = 0; i < count; ++i) {
        const Calibration calibration =
            render::ball_scene_camera(i, count, 180, {640, 576}, {1280, 720});
        constexpr double noise_mm = 2;
        auto images = render::ball_scene_images(calibration, noise_mm, unsigned(i));
        cameras.push_back({calibration, std::move(images.depth), std::move(images.color)});
    }
    return cameras;
}

nlohmann::json bench_render(const RenderBench& bench) {
    if (bench.cameras.empty())
        throw Error("The render benchmark needs at least one camera.");
    std::vector<std::string> renderers =
        bench.renderers.empty() ? render::renderer_names() : bench.renderers;
    renderers.emplace_back(render::yardstick_renderer);

    render::OffscreenContext context;
    for (const std::string& renderer : renderers)
        check_renderer(bench.cameras.front(), renderer);

    const int count = int(bench.cameras.size());
    std::vector<std::vector<double>> frame_ms(renderers.size()), upload_ms(renderers.size());
    nlohmann::json rooms;
    {
        CloudSet scene;
        scene.set_depth_step(bench.depth_step);
        for (int i = 0; i < count; ++i)
            scene.set_camera(CameraId(i), bench.cameras[std::size_t(i)].calibration);
        const Calibration& first = bench.cameras.front().calibration;
        const CameraView view =
            render::view_of_camera(first.depth, first.room_from_camera, bench.picture);
        const render::RenderTarget target(bench.picture);
        // Renderers take turns, so that a load peak does not affect only one. The first round
        // compiles programs and allocates buffers and is not counted.
        for (int round = 0; round <= bench.repetitions; ++round)
            for (std::size_t r = 0; r < renderers.size(); ++r) {
                const double up = gpu_ms([&] {
                    for (int i = 0; i < count; ++i)
                        upload(scene, i, bench.cameras[std::size_t(i)]);
                });
                const double frame = gpu_ms([&] {
                    target.clear(black);
                    scene.draw(view, target.target(), renderers[r]);
                });
                if (round > 0) {
                    upload_ms[r].push_back(up / count);
                    frame_ms[r].push_back(frame);
                }
            }
        rooms = bench_rooms(bench, view, target, scene);
    }
    if (context.errors() > 0)
        throw Error("The graphics driver reports an error: " + context.first_error());

    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t r = 0; r < renderers.size(); ++r)
        rows.push_back({{"name", renderers[r]},
                        {"frame_ms", median(frame_ms[r])},
                        {"upload_ms", median(upload_ms[r])}});
    return {{"gl_renderer", context.renderer_name()},
            {"width", bench.picture.width},
            {"height", bench.picture.height},
            {"cameras", count},
            {"depth_step", bench.depth_step},
            {"renderers", rows},
            {"rooms", rooms}};
}

}  // namespace theatron::bench
