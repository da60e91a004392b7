// SPDX-License-Identifier: Apache-2.0
#include "compare_scene.h"

#include <atomic>
#include <thread>

#include "base/error.h"
#include "codec/rvl.h"
#include "compare.h"
#include "synthetic/frame_maker.h"

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

}  // namespace

CompareScene make_compare_scene(const CompareSceneOptions& options,
                                const capture::Progress& progress) {
    progress("building the generated operating room", 0);
    const synthetic::OperatingRoom room(loop_of(options, 0).scene);
    CompareScene scene;
    scene.cameras.resize(std::size_t(options.cameras));
    std::vector<ViewBenchCamera> last(scene.cameras.size());
    std::atomic<int> done = 0;
    const int all = options.cameras * options.frames;
    std::vector<std::exception_ptr> failures(scene.cameras.size());
    std::mutex telling;
    const auto make = [&](int index) {
        const synthetic::LoopOptions loop = loop_of(options, index);
        CompareCamera& camera = scene.cameras[std::size_t(index)];
        camera.calibration = synthetic::loop_calibration(loop);
        const auto view = room.look_from(camera.calibration, {true, true, true});
        synthetic::FrameMaker maker(loop);
        for (int i = 0; i < options.frames; ++i) {
            synthetic::GroundTruth truth = view->render(*room.at(moment_of(i)));
            add_frame(camera, maker, truth, i);
            const std::lock_guard lock(telling);
            progress("drawing what the cameras see", ++done / double(all));
            if (i + 1 < options.frames)
                continue;
            ViewBenchCamera& exact = last[std::size_t(index)];
            exact.calibration = camera.calibration;
            exact.exact_depth_m = std::move(truth.depth_m);
            exact.depth[ViewBenchCamera::frames - 1] = camera.depth.back();
            camera.last_exact = std::move(truth.color);
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 0; i < options.cameras; ++i)
        threads.emplace_back([&, i] {
            try {
                make(i);
            } catch (...) {
                failures[std::size_t(i)] = std::current_exception();
            }
        });
    threads.clear();
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);

    const auto moment = room.at(moment_of(options.frames - 1));
    const std::pair<double, const char*> places[] = {
        {2, "at the foot of the table"}, {24, "a step to the left"}, {-20, "a step to the right"}};
    const double all_pictures = double(std::size(places)) + 1;
    const auto seen_from = [&](Vec3 eye, double fov_degrees) {
        return make_view_bench_place(room, *moment, last, {eye, wound, fov_degrees},
                                     options.picture);
    };
    for (const auto& [degrees, name] : places) {
        scene.places.push_back(seen_from(beside_table(degrees, 1.6, 1.75), 60));
        scene.place_names.emplace_back(name);
        progress("drawing what the expert would see", double(scene.places.size()) / all_pictures);
    }
    const Vec3 first = beside_table(places[0].first, 1.6, 1.75);
    scene.wound = wound;
    scene.close_up = seen_from(
        first, 2 * std::atan(close_up_width_m / 2 / length(wound - first)) / radians_of(1));
    progress("drawing what the expert would see", 1);
    return scene;
}

}  // namespace theatron::bench
