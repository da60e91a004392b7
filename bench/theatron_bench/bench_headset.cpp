// SPDX-License-Identifier: Apache-2.0
#include "bench_headset.h"

#include <algorithm>

#include "base/error.h"
#include "base/statistics.h"

namespace theatron::bench {
namespace {

constexpr double eye_distance_m = 0.063;
constexpr Rgb black{};
constexpr Size small_eye{144, 160};

render::CameraView view_before(const RenderBenchCamera& camera, Size eye) {
    const Calibration& c = camera.calibration;
    return render::view_towards(c.room_from_camera.translation,
                                render::point_of_interest(c, camera.depth.view()),
                                vive_pro_eye_degrees, eye);
}

}  // namespace

HeadsetBench::HeadsetBench(std::vector<RenderBenchCamera> cameras, Size eye)
    : cameras_(std::move(cameras)),
      middle_(view_before(cameras_.front(), eye)),
      left_(eye),
      right_(eye),
      small_left_(small_eye),
      small_right_(small_eye),
      programs_(std::make_shared<render::CloudPrograms>()) {}

FurnishedRoom& HeadsetBench::room(render::SceneQuality quality) {
    return rooms_.try_emplace(quality, quality, middle_).first->second;
}

render::CloudSet& HeadsetBench::clouds(int count) {
    const auto [place, is_new] = clouds_.try_emplace(count, programs_);
    for (int i = 0; is_new && i < count; ++i)
        place->second.set_camera(CameraId(i), cameras_[std::size_t(i)].calibration);
    return place->second;
}

void HeadsetBench::check_cloud(int count, const std::string& renderer) {
    const render::Picture drawn = clouds(count).render(middle_, {160, 120}, renderer);
    if (std::all_of(drawn.depth_mm.pixels.begin(), drawn.depth_mm.pixels.end(),
                    [](std::uint16_t mm) { return mm == 0; }))
        throw Error("The renderer " + renderer + " shows nothing of the cameras.");
}

void HeadsetBench::draw(int count, const std::string& renderer, render::SceneQuality quality,
                        const render::RenderTarget& left, const render::RenderTarget& right) {
    const auto eyes = render::stereo_pair(middle_, eye_distance_m);
    for (int i = 0; i < count; ++i)
        upload(clouds(count), i, cameras_[std::size_t(i)]);
    left.clear(black);
    right.clear(black);
    render::draw({&room(quality).fill(),
                  {{&clouds(count), renderer}},
                  {{eyes[0], left.target()}, {eyes[1], right.target()}}},
                 &passes_);
}

double HeadsetBench::picture_ms(int count, const std::string& renderer,
                                render::SceneQuality quality, const HeadsetTiming& timing) {
    if (drawn_.emplace(count, renderer, quality).second) {
        draw(count, renderer, quality, small_left_, small_right_);
        check_cloud(count, renderer);
    }
    std::vector<double> times;
    double spent_ms = 0;
    while (times.empty() ||
           (int(times.size()) < timing.pictures && spent_ms < 1000 * timing.seconds)) {
        times.push_back(gpu_ms([&] { draw(count, renderer, quality, left_, right_); }));
        spent_ms += times.back();
    }
    if (context_.errors() > 0)
        throw Error("The graphics driver reports an error: " + context_.first_error());
    return median(times);
}

}  // namespace theatron::bench
