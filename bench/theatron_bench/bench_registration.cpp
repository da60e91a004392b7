// SPDX-License-Identifier: Apache-2.0
#include "bench_registration.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "registration/board_scene.h"
#include "registration/frame_mean.h"
#include "registration/rig_solver.h"
#include "synthetic/operating_room.h"
#include "synthetic/sensor_model.h"

namespace theatron::bench {
namespace {

using namespace registration;

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) / 1e6;
}

double zstd_ms(const DepthImage& depth) {
    const std::size_t bytes = depth.pixels.size() * sizeof(std::uint16_t);
    std::vector<char> packed(ZSTD_compressBound(bytes));
    const double begin = cpu_ms();
    ZSTD_compress(packed.data(), packed.size(), depth.pixels.data(), bytes, 1);
    return cpu_ms() - begin;
}

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double between(double a, double b) {
        return a + (b - a) * double(engine_()) / double(std::mt19937::max());
    }

private:
    std::mt19937 engine_;
};

double angle_between(const Pose& a, const Pose& b) {
    const Quat d = conjugate(a.rotation) * b.rotation;
    return 2 * std::asin(std::min(1.0, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

double quantile(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

// `noise`: factor of the deviation of one measurement.
synthetic::DepthSensorParams sensor_params(bool fixed_errors, double noise = 1) {
    synthetic::DepthSensorParams params = synthetic::nfov_unbinned();
    params.shot_mm2 *= float(noise * noise);
    params.read_mm2 *= float(noise * noise);
    if (!fixed_errors)
        params.offset_mm = params.scale = params.wiggle_mm = params.field_mm = params.fixed_mm =
            params.multipath = 0;
    return params;
}

// The operating room with its team as a scene that boards are put into.
BoardScene room_scene(const synthetic::GroundTruth& truth, const Image<Ray>& rays) {
    BoardScene scene(truth.depth_m.size, 0);
    scene.depth_m = truth.depth_m;
    for (std::size_t i = 0; i < truth.surface.pixels.size(); ++i) {
        const synthetic::SurfaceSample& s = truth.surface.pixels[i];
        const Ray ray = rays.pixels[i];
        const double length = std::sqrt(ray.x * ray.x + ray.y * ray.y + 1.0);
        scene.reflectivity.pixels[i] = s.infrared;
        scene.cos_incidence.pixels[i] =
            float(std::max(0.0, -(s.nx * ray.x + s.ny * ray.y + s.nz) / length));
    }
    return scene;
}

// The share of the board's pixels that nothing hides.
double seen_share(const BoardScene& before, const Image<BoardHit>& board) {
    int seen = 0, all = 0;
    for (std::size_t i = 0; i < board.pixels.size(); ++i)
        if (board.pixels[i].depth_m > 0) {
            ++all;
            const float other = before.depth_m.pixels[i];
            seen += other == 0 || other > board.pixels[i].depth_m;
        }
    return all > 0 ? double(seen) / all : 0;
}

// Cameras in free places around the room's table, from which a board stands free up to 3.5 m away.
Pose free_camera(int i) {
    constexpr double places[][2] = {{1.05, 4.2}, {2.09, 4.2}, {0, 3.6}, {4.19, 5}};
    const auto [angle, radius] = places[i % int(std::size(places))];
    const double x = std::sin(angle), z = std::cos(angle);
    return look_at({radius * x, 1.9, radius * z}, {0.6 * z, 1, -0.6 * x}, {0, 1, 0});
}

nlohmann::json detection(const RegistrationBenchOptions& options,
                         const capture::Progress& progress) {
    Calibration calibration = synthetic::synthetic_camera(synthetic::Variant::room, 0, 2, {});
    const CameraModel camera = calibration.depth;
    const Image<Ray> rays = make_ray_table(camera);
    const LatticeTarget target = large_target();
    synthetic::SceneOptions scene_options;
    scene_options.detail = 0.3;
    const synthetic::OperatingRoom room(scene_options);
    LatticeDetector detector(camera, calibration.depth_unit_mm, target);
    Random random(3);
    int with_board = 0, found = 0, wrong = 0;
    std::vector<double> times, yardstick_times, shifts, turns;
    BoardScene empty(camera.size, 0);
    constexpr int images_of_a_view = 20;
    for (int i = 0; i < options.images; ++i) {
        if (i % images_of_a_view == 0) {
            calibration.room_from_camera = free_camera(i / images_of_a_view);
            const auto view =
                room.look_from(calibration, {.depth = true, .surface = true, .color = false});
            empty = room_scene(view->render(*room.at(std::chrono::milliseconds(100 * i))), rays);
            progress("boards in single images", double(i) / options.images);
        }
        BoardScene scene = empty;
        const bool has_board = i % 4 != 0;
        Pose pose;
        // The distance is kept while free places are looked for: all distances are as frequent.
        double distance = random.between(1, 3.5);
        for (int tries = 1, stands_free = !has_board; !stands_free; ++tries) {
            if (tries % 100 == 0)
                distance = random.between(1, 3.5);
            const double tilt = random.between(0, 50);
            const double about = random.between(0, 6.283), off = 0.02 + 0.3 * (distance - 1) / 2.5;
            pose =
                board_pose(distance, {random.between(-off, off), random.between(-off, off)},
                           tilt * std::cos(about), tilt * std::sin(about), random.between(0, 360));
            stands_free = seen_share(empty, board_image(target, pose, rays)) > 0.98;
        }
        if (has_board)
            scene.add(target, pose, rays);
        synthetic::DepthSensor sensor(sensor_params(true), camera.size, std::uint32_t(i));
        const DepthImage depth = scene.seen_by(sensor, std::uint32_t(i));
        const double begin = cpu_ms();
        const auto detected = detector.detect(depth.view());
        times.push_back(cpu_ms() - begin);
        yardstick_times.push_back(zstd_ms(depth));
        with_board += has_board;
        if (!detected)
            continue;
        const double shift = length(detected->camera_from_board.translation - pose.translation);
        // The right board, not only one: a wrong way to see it is off by half a turn.
        const bool right =
            has_board && shift < 0.03 && angle_between(detected->camera_from_board, pose) < 0.03;
        ++(right ? found : wrong);
        if (right) {
            shifts.push_back(shift * 1000);
            turns.push_back(angle_between(detected->camera_from_board, pose) * 1000);
        }
    }
    return {{"precision", double(found) / std::max(1, found + wrong)},
            {"recall", double(found) / std::max(1, with_board)},
            {"ms", quantile(times, 0.5)},
            {"p90_ms", quantile(times, 0.9)},
            {"zstd1_ms", quantile(yardstick_times, 0.5)},  // of the same images, for comparison
            {"images", options.images},
            {"images_with_board", with_board},
            {"median_shift_mm", quantile(shifts, 0.5)},
            {"median_turn_mrad", quantile(turns, 0.5)}};
}

struct Case {
    double distance_m = 2, angle_deg = 90;
    int cameras = 2, poses = 10;
    bool fixed_errors = true;
    double bias_mm = 0;    // every camera measures this much too far, beside its fixed errors
    double occlusion = 0;  // share of the picture's rows that an arm hides
    double noise = 1;      // factor
};

Pose ring_camera(double degrees, double radius_m) {
    const double a = radians_of(degrees);
    return look_at({radius_m * std::sin(a), 1.55, radius_m * std::cos(a)}, {0, 1.3, 0}, {0, 1, 0});
}

// One view of one camera; nothing if the board was not found.
std::optional<Detection> one_view(LatticeDetector& detector, synthetic::DepthSensor& sensor,
                                  const BoardScene& scene, const Case& c, int frames,
                                  std::uint32_t first_frame) {
    FrameMean mean(scene.depth_m.size);
    for (int f = 0; f < frames; ++f) {
        DepthImage depth = scene.seen_by(sensor, first_frame + std::uint32_t(f));
        for (std::uint16_t& pixel : depth.pixels)
            if (pixel != 0)
                pixel = std::uint16_t(pixel + std::lround(c.bias_mm));
        mean.add(std::as_const(depth).view());
    }
    const DepthImage image = mean.mean();
    return detector.detect(image.view(), FitEffort::measure);
}

struct Outcome {
    std::optional<double> error_mm;  // over the working volume, of the worst camera; if solved
    double solve_ms = 0;
    std::vector<double> offset_errors_mm;  // of each camera
};

Outcome outcome(const Case& c, std::uint32_t seed, int frames) {
    const CameraModel camera =
        synthetic::synthetic_camera(synthetic::Variant::room, 0, 1, {}).depth;
    const Image<Ray> rays = make_ray_table(camera);
    const LatticeTarget target = large_target();
    LatticeDetector detector(camera, 1.0 / FrameMean::finer, target);
    Random random(seed * 7 + 1);
    std::vector<Pose> room_from_camera;
    std::vector<synthetic::DepthSensor> sensors;
    for (int i = 0; i < c.cameras; ++i) {
        const double step = c.cameras > 2 ? 360.0 / c.cameras : c.angle_deg;
        room_from_camera.push_back(ring_camera((i - 0.5) * step, c.distance_m));
        sensors.emplace_back(sensor_params(c.fixed_errors, c.noise), camera.size,
                             1000 + seed * 16 + std::uint32_t(i));
    }
    std::vector<BoardView> views;
    for (int place = 0; place < c.poses; ++place) {
        // One pose: nearly square to the line between the cameras, turned a little in itself.
        const double spread = c.poses > 1 ? 1 : 0.1;
        // In a ring the board is turned to each neighbouring pair in turn.
        const double toward = c.cameras > 2 ? 2 * std::numbers::pi * place / c.cameras : 0;
        const Quat tilt = rotation_about({1, 0, 0}, random.between(-0.35, 0.35) * spread) *
                          rotation_about({0, 1, 0}, random.between(-0.3, 0.3) * spread) *
                          rotation_about({0, 0, 1}, 0.15 + random.between(-0.5, 0.5) * spread);
        const Pose room_from_board{
            rotation_about({0, 1, 0}, toward) * tilt,
            {random.between(-0.5, 0.5) * spread, 1.3 + random.between(-0.35, 0.35) * spread,
             random.between(-0.5, 0.5) * spread}};
        for (int i = 0; i < c.cameras; ++i) {
            const auto k = std::size_t(i);
            BoardScene scene(camera.size, c.distance_m + 2);
            scene.add(target, inverse(room_from_camera[k]) * room_from_board, rays);
            const int rows = int(c.occlusion * 200), top = 288 + int(random.between(-80, 80));
            for (int y = top; y < std::min(576, top + rows); ++y)
                std::fill_n(scene.depth_m.view().row(y), 320, float(c.distance_m - 0.6));
            const auto detected =
                one_view(detector, sensors[k], scene, c, frames, std::uint32_t(place * 100));
            if (detected)
                views.push_back({i, place, *detected});
        }
    }
    Outcome result;
    const double begin = cpu_ms();
    const RigSolution solution = solve_rig(c.cameras, c.poses, views, target);
    result.solve_ms = cpu_ms() - begin;
    if (!solution.converged)
        return result;
    for (std::size_t i = 0; i < sensors.size(); ++i)
        result.offset_errors_mm.push_back(
            std::abs(solution.cameras[i].bias.offset_m * 1000 - c.bias_mm -
                     sensors[i].distance_error_mm(float(DepthBias::reference_m * 1000))));
    // The worst camera counts.
    double worst = 0;
    for (std::size_t i = 1; i < sensors.size(); ++i) {
        const Pose truth = inverse(room_from_camera[0]) * room_from_camera[i];
        const Pose camera_from_room = inverse(room_from_camera[i]);
        double sum = 0;
        int n = 0;
        for (int x = -7; x <= 7; ++x)
            for (int z = -7; z <= 7; ++z)
                for (int y = 8; y <= 18; ++y, ++n) {
                    const Vec3 p = camera_from_room * (Vec3{double(x), double(y), double(z)} * 0.1);
                    sum += length(solution.cameras[i].reference_from_camera * p - truth * p);
                }
        worst = std::max(worst, sum / n * 1000);
    }
    result.error_mm = worst;
    return result;
}

// `told` gets the share of the seeds that is done.
nlohmann::json measured(const Case& c, const RegistrationBenchOptions& options,
                        const std::function<void(double)>& told) {
    std::vector<double> errors, offset_errors;
    double solve_ms = 0;
    for (int seed = 0; seed < options.seeds;) {
        told(double(seed) / options.seeds);
        std::vector<std::future<Outcome>> running;
        for (int i = 0; i < options.threads && seed < options.seeds; ++i, ++seed)
            running.push_back(
                std::async(std::launch::async, outcome, c, std::uint32_t(seed), options.frames));
        for (std::future<Outcome>& future : running) {
            const Outcome one = future.get();
            solve_ms = std::max(solve_ms, one.solve_ms);
            if (one.error_mm)
                errors.push_back(*one.error_mm);
            offset_errors.insert(offset_errors.end(), one.offset_errors_mm.begin(),
                                 one.offset_errors_mm.end());
        }
    }
    double mean = 0;
    for (const double e : errors)
        mean += e / double(errors.size());
    return {{"distance_m", c.distance_m},
            {"angle_deg", c.cameras > 2 ? 360.0 / c.cameras : c.angle_deg},
            {"cameras", c.cameras},
            {"poses", c.poses},
            {"fixed_errors", c.fixed_errors},
            {"bias_mm", c.bias_mm},
            {"occlusion", c.occlusion},
            {"noise", c.noise},
            {"seeds", options.seeds},
            {"solved", errors.size()},
            {"frames", options.frames},
            {"mean_error_mm", mean},
            {"median_error_mm", quantile(errors, 0.5)},
            {"p90_error_mm", quantile(errors, 0.9)},
            {"median_offset_error_mm", quantile(offset_errors, 0.5)},
            {"solve_ms", solve_ms}};
}

std::vector<Case> cases() {
    return {{.poses = 1, .fixed_errors = false},
            {.poses = 10, .fixed_errors = false},
            {.poses = 1},
            {.poses = 10},
            {.distance_m = 1.5},
            {.distance_m = 3},
            {.angle_deg = 45},
            {.bias_mm = 5},
            {.occlusion = 0.2},
            {.noise = 2},
            {.cameras = 4}};
}

}  // namespace

nlohmann::json bench_registration(const RegistrationBenchOptions& options,
                                  const capture::Progress& progress) {
    nlohmann::json result{{"detection", detection(options, progress)},
                          {"registration", nlohmann::json::array()}};
    const std::vector<Case> all = cases();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = "cameras registered, case " + std::to_string(i + 1) + " of " +
                                 std::to_string(all.size());
        result["registration"].push_back(
            measured(all[i], options, [&](double done) { progress(name, done); }));
    }
    return result;
}

}  // namespace theatron::bench
