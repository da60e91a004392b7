// SPDX-License-Identifier: Apache-2.0
#include "compare_scene.h"

#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "base/error.h"
#include "codec/rvl.h"
#include "compare.h"
#include "compare_sights.h"
#include "synthetic/frame_maker.h"
#include "synthetic/sensor_model.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

constexpr double first_moment_s = 3;  // of the room's loop: hands are at work
constexpr Vec3 wound{0, 1.12, 0.05};

synthetic::LoopOptions loop_of(const CompareSceneOptions& options, int camera) {
    synthetic::LoopOptions loop;
    loop.camera = camera;
    loop.cameras = options.cameras;
    if (options.quick) {
        loop.scene.detail = 0.2;
        loop.depth_divisor = 2;
        loop.color = {640, 360};
    }
    return loop;
}

Vec3 beside_table(double degrees, double radius, double height) {
    const double a = radians_of(degrees);
    return {radius * std::cos(a), height, radius * std::sin(a)};
}

Duration moment_of(int frame) {
    return seconds_to_duration(first_moment_s + frame / compare_pictures_per_s);
}

// An arm over the table's foot, below the lamps: about a metre from the wound.
constexpr Vec3 near_place{0.8, 1.85, 0.05};

Calibration calibration_of(const synthetic::LoopOptions& loop, bool is_near) {
    Calibration calibration = synthetic::loop_calibration(loop);
    if (is_near)
        calibration.room_from_camera = look_at(near_place, wound, {0, 1, 0});
    return calibration;
}

double fov_of_close_up(Vec3 eye) {
    return 2 * std::atan(close_up_width_m / 2 / length(wound - eye)) / radians_of(1);
}

// The exact distances at the pixels of the colour camera.
Image<float> distances_at_lens(const synthetic::OperatingRoom& room,
                               const synthetic::RoomMoment& moment,
                               const Calibration& calibration) {
    Calibration lens;
    lens.depth = calibration.color;
    lens.room_from_camera = calibration.room_from_camera * inverse(calibration.color_from_depth);
    lens.registered = true;
    return std::move(room.look_from(lens, {.depth = true, .surface = false, .color = false})
                         ->render(moment)
                         .depth_m);
}

constexpr std::uint32_t zoomed_seed = 5003, full_hd_seed = 5009;

Calibration full_hd_calibration(const CompareSceneOptions& options) {
    synthetic::LoopOptions loop = loop_of(options, 0);
    loop.color = options.quick ? Size{960, 540} : Size{1920, 1080};
    return synthetic::loop_calibration(loop);
}

Calibration zoomed_calibration(const CompareSceneOptions& options) {
    const synthetic::LoopOptions loop = loop_of(options, 0);
    const Vec3 eye = synthetic::loop_calibration(loop).room_from_camera.translation;
    return synthetic::free_viewpoint(eye, wound, loop.color, fov_of_close_up(eye));
}

// `drawn` is called after each picture.
CompareCamera make_video_camera(const synthetic::OperatingRoom& room,
                                const Calibration& calibration, std::uint32_t seed, int frames,
                                const std::function<void()>& drawn) {
    CompareCamera camera{.calibration = calibration};
    const auto view =
        room.look_from(calibration, {.depth = false, .surface = false, .color = true});
    const auto encoder =
        video::make_color_encoder(video::parse_color_setting("jpeg:quality=90").setting);
    for (int i = 0; i < frames; ++i) {
        camera.last_exact = view->render(*room.at(moment_of(i))).color;
        const Size size = camera.last_exact.size;
        ColorData noisy;
        noisy.size = size;
        noisy.pixels.resize(size);
        synthetic::apply_color_sensor({}, seed, std::uint32_t(i), camera.last_exact.view(),
                                      noisy.pixels.view());
        const auto encoded = encoder->encode(noisy, true);
        if (!encoded)
            throw Error("A picture of the generated room could not be compressed.");
        ColorData& jpeg = camera.color.emplace_back();
        jpeg.size = size;
        jpeg.jpeg.assign(encoded->bytes.begin(), encoded->bytes.end());
        drawn();
    }
    camera.last_exact_m = distances_at_lens(room, *room.at(moment_of(frames - 1)), calibration);
    return camera;
}

void add_frame(CompareCamera& camera, synthetic::FrameMaker& maker,
               const synthetic::GroundTruth& truth, int number) {
    synthetic::EncodedFrame encoded = maker.encode(truth, std::uint32_t(number));
    DepthImage depth(camera.calibration.depth.size);
    if (codec::rvl::decode(encoded.depth, depth.view()) != Status::ok)
        throw Error("A depth image of the generated room is damaged.");
    camera.depth.push_back(std::move(depth));
    ColorData color;
    color.size = truth.color.size;
    color.jpeg = std::move(encoded.color);
    camera.color.push_back(std::move(color));
}

// Runs all works side by side; throws what one of them threw.
void run_all(const std::vector<std::function<void()>>& works) {
    std::vector<std::exception_ptr> failures(works.size());
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < works.size(); ++i)
        threads.emplace_back([&, i] {
            try {
                works[i]();
            } catch (...) {
                failures[i] = std::current_exception();
            }
        });
    threads.clear();
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

}  // namespace

std::vector<const CompareCamera*> CompareScene::usual_cameras() const {
    std::vector<const CompareCamera*> usual;
    for (std::size_t i = 0; i + 1 < cameras.size(); ++i)
        usual.push_back(&cameras[i]);
    return usual;
}

CompareScene make_compare_scene(const CompareSceneOptions& options,
                                const capture::Progress& progress) {
    progress("building the generated operating room", 0);
    const synthetic::OperatingRoom room(loop_of(options, 0).scene);
    CompareScene scene;
    const int cameras = options.cameras + 1;
    scene.cameras.resize(std::size_t(cameras));
    std::vector<ViewBenchCamera> last(scene.cameras.size());
    int done = 0;
    const double all = double(cameras + 2) * options.frames;
    std::mutex telling;
    const auto drawn = [&] {
        const std::lock_guard lock(telling);
        progress("drawing what the cameras see", ++done / all);
    };
    const auto make = [&](int index) {
        const synthetic::LoopOptions loop = loop_of(options, index);
        CompareCamera& camera = scene.cameras[std::size_t(index)];
        camera.calibration = calibration_of(loop, index == options.cameras);
        const auto view = room.look_from(camera.calibration, {true, true, true});
        synthetic::FrameMaker maker(loop);
        for (int i = 0; i < options.frames; ++i) {
            synthetic::GroundTruth truth = view->render(*room.at(moment_of(i)));
            add_frame(camera, maker, truth, i);
            drawn();
            if (i + 1 < options.frames)
                continue;
            ViewBenchCamera& exact = last[std::size_t(index)];
            exact.calibration = camera.calibration;
            exact.exact_depth_m = std::move(truth.depth_m);
            exact.depth[ViewBenchCamera::frames - 1] = camera.depth.back();
            camera.last_exact = std::move(truth.color);
            camera.last_exact_m =
                distances_at_lens(room, *room.at(moment_of(i)), camera.calibration);
        }
    };
    std::vector<std::function<void()>> works = {
        [&] {
            scene.full_hd = make_video_camera(room, full_hd_calibration(options), full_hd_seed,
                                              options.frames, drawn);
        },
        [&] {
            scene.zoomed = make_video_camera(room, zoomed_calibration(options), zoomed_seed,
                                             options.frames, drawn);
        }};
    for (int i = 0; i < cameras; ++i)
        works.emplace_back([&make, i] { make(i); });
    run_all(works);

    const auto moment = room.at(moment_of(options.frames - 1));
    const std::pair<double, const char*> places[] = {
        {2, "at the foot of the table"}, {24, "a step to the left"}, {-20, "a step to the right"}};
    const auto without_near = std::vector(last.begin(), last.end() - 1);
    const double all_pictures = 2 * (double(std::size(places)) + 1);
    int places_drawn = 0;
    const auto seen_from = [&](const std::vector<ViewBenchCamera>& by, Vec3 eye, double fov) {
        ViewBenchPlace place =
            make_view_bench_place(room, *moment, by, {eye, wound, fov}, options.picture);
        progress("drawing what the expert would see", ++places_drawn / all_pictures);
        return place;
    };
    scene.wound = wound;
    for (const bool near : {false, true}) {
        const std::vector<ViewBenchCamera>& by = near ? last : without_near;
        CompareViews& views = near ? scene.with_near : scene.without_near;
        for (const auto& [degrees, name] : places)
            views.places.push_back(seen_from(by, beside_table(degrees, 1.6, 1.75), 60));
        const Vec3 first = beside_table(places[0].first, 1.6, 1.75);
        views.close_up = seen_from(by, first, fov_of_close_up(first));
        views.near_wound = region_around(views.close_up.view, options.picture, wound, near_wound_m);
    }
    for (const auto& [degrees, name] : places)
        scene.place_names.emplace_back(name);
    return scene;
}

}  // namespace theatron::bench
